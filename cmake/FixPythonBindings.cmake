# lcm-gen 1.3.1 writes Python 2: its map() returned a list. In Python 3 a decoded array of booleans
# would be an iterator that can be read only once. And a message decodes the frozen ones that it has
# grown from.
#   cmake -DFOLDER=... -P FixPythonBindings.cmake
file(GLOB modules ${FOLDER}/*_t.py)
foreach(module ${modules})
  file(READ ${module} code)
  string(REGEX REPLACE "= map\\(bool, ([^\n]*)\\)\n" "= list(map(bool, \\1))\n" code "${code}")
  # Messages grow (lcmtypes/README.md): X_t also decodes each frozen X_v<number>_t.
  get_filename_component(type ${module} NAME_WE)
  string(REGEX REPLACE "_t$" "" stem ${type})
  file(GLOB frozen ${FOLDER}/${stem}_v*_t.py)
  string(REPLACE "        if buf.read(8) != ${type}"
                 "        fingerprint = buf.read(8)\n        if fingerprint != ${type}" code "${code}")
  foreach(former ${frozen})
    get_filename_component(former ${former} NAME_WE)
    string(REPLACE "        if fingerprint != ${type}"
                   "        from ols_msg.${former} import ${former}
        if fingerprint == ${former}._get_packed_fingerprint():
            former, grown = ${former}._decode_one(buf), ${type}()
            for name in former.__slots__:
                setattr(grown, name, getattr(former, name))
            return grown
        if fingerprint != ${type}" code "${code}")
  endforeach()
  file(WRITE ${module} "${code}")
endforeach()
