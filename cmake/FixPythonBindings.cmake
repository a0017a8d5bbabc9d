# lcm-gen 1.3.1 writes Python 2: its map() returned a list. In Python 3 a decoded array of booleans
# would be an iterator that can be read only once.
#   cmake -DFOLDER=... -P FixPythonBindings.cmake
file(GLOB modules ${FOLDER}/*_t.py)
foreach(module ${modules})
  file(READ ${module} code)
  string(REGEX REPLACE "= map\\(bool, ([^\n]*)\\)\n" "= list(map(bool, \\1))\n" code "${code}")
  file(WRITE ${module} "${code}")
endforeach()
