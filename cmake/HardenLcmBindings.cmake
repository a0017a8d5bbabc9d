# lcm-gen 1.3.1 trusts the lengths in a datagram: a string of negative length is read far beyond the
# packet, and an array is allocated with any stated size, so a forged packet would crash the process.
# This adds checks of every length against the rest of the packet to the generated decoders.
#   cmake -DFOLDER=... -P HardenLcmBindings.cmake
file(GLOB headers ${FOLDER}/*.hpp)
foreach(header ${headers})
  file(READ ${header} code)
  string(REGEX MATCHALL "decode_array\\(buf, offset [+] pos, maxlen - pos, &__[a-z_0-9]+, 1\\)" texts
                        "${code}")
  string(REGEX MATCHALL "if\\(__[a-z_0-9]+ > maxlen - pos\\) return -1" checks "${code}")
  list(LENGTH texts wanted)
  list(LENGTH checks found)
  if(NOT wanted EQUAL found)
    message(FATAL_ERROR "${header}: lcm-gen's code is not as expected: ${wanted} texts, ${found} checks")
  endif()
  string(REGEX REPLACE "if\\((__[a-z_0-9]+) > maxlen - pos\\) return -1;"
                       "if(\\1 < 1 || \\1 > maxlen - pos) return -1;" code "${code}")
  # An element has at least one byte.
  string(REGEX REPLACE "(this->[a-z_0-9]+[.]resize\\((this->[a-z_0-9]+)\\);)"
                       "if(\\2 < 0 || \\2 > maxlen - pos) return -1;\n        \\1" code "${code}")
  file(WRITE ${header} "${code}")
endforeach()
