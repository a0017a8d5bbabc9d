# lcm-gen 1.3.1 writes Python 2: there map() was a list. As decoded, an array of booleans can be read
# once, and is empty then.
#   cmake -DFOLDER=... -P FixPythonBindings.cmake
file(GLOB modules ${FOLDER}/*_t.py)
foreach(module ${modules})
  file(READ ${module} code)
  string(REGEX REPLACE "= map\\(bool, ([^\n]*)\\)\n" "= list(map(bool, \\1))\n" code "${code}")
  file(WRITE ${module} "${code}")
endforeach()
