# lcm-gen 1.3.1 trusts the lengths in a datagram: a string of negative length is read far beyond the
# packet, and an array is allocated with any stated size, so a forged packet would crash the process.
# This adds checks of every length against the rest of the packet to the generated decoders, and lets a
# message decode the frozen ones that it has grown from.
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
  # Messages grow (lcmtypes/README.md): X_t also decodes each frozen X_v<number>_t.
  string(REGEX REPLACE "_t[.]hpp$" "" stem ${header})
  file(GLOB frozen ${stem}_v*_t.hpp)
  foreach(former ${frozen})
    get_filename_component(former ${former} NAME_WE)
    string(REPLACE "if (msg_hash != getHash()) return -1;"
                   "if (msg_hash == ${former}::getHash())
        return ols_lcm::decode_former<${former}>(*this, buf, offset, maxlen, pos);
    if (msg_hash != getHash()) return -1;" code "${code}")
    string(REPLACE "#include <lcm/lcm_coretypes.h>"
                   "#include <lcm/lcm_coretypes.h>\n#include \"lcmtypes/former.h\"\n#include \"ols_msg/${former}.hpp\""
                   code "${code}")
  endforeach()
  file(WRITE ${header} "${code}")
endforeach()
