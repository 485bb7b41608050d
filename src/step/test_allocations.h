#pragma once

// Allocations that fail on demand: test_allocations.cpp replaces operator new of the program that it is part
// of.

namespace remodel::test {

extern long allocations;       // so far
extern long allocations_left;  // until one fails; -1: none fails
extern bool fails_for_good;    // all further ones fail too, until allocations_left is set to -1

}  // namespace remodel::test
