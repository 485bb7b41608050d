#pragma once

// Files as bytes of the program.

#include <string_view>

// Defines std::string_view function(), the bytes of the file; name makes the symbols unique.
#define REMODEL_EMBED(function, name, file)                                                  \
  extern "C" const char remodel_embedded_##name[];                                           \
  extern "C" const char remodel_embedded_##name##_end[];                                     \
  asm(".pushsection .rodata\n"                                                               \
      ".global remodel_embedded_" #name "\n.global remodel_embedded_" #name "_end\n"         \
      "remodel_embedded_" #name ":\n.incbin \"" file "\"\nremodel_embedded_" #name "_end:\n" \
      ".byte 0\n.popsection\n");                                                             \
  std::string_view function() { return {remodel_embedded_##name, remodel_embedded_##name##_end}; }
