// Tests get their compiled headers by this file's object: cmake/RemodelTargets.cmake.
#include "headers.h"
