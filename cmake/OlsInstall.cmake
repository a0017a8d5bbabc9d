# `cmake --install BUILD --prefix /usr` (DESTDIR is honoured): programs, units and what they need,
# examples, documents. The units find the programs in /usr/bin and /usr/local/bin.
include(GNUInstallDirs)

# Outside lib/<architecture>: systemd and udev look there.
set(OLS_SYSTEM_LIBDIR lib CACHE STRING "Where the folders of systemd and udev are")
set(OLS_PYTHON_INSTALL_DIR lib/python3/dist-packages CACHE STRING "Where the Python module goes")

# What a package build builds: nothing that only developers run.
add_custom_target(shipped)
foreach(program IN ITEMS ols-station ols-fusion ols-ctl ols-doctor ols-logger ols-track ols-fuse
                         ols-precision ols-stationing ols-calibrate ols-console ols-bridge ols-cue ols-export ols-exporter
                         ols-key ols-land ols-setup)
  install(TARGETS ${program} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  add_dependencies(shipped ${program})
endforeach()
# The simulator is not installed by default: cmake --install BUILD --component simulator.
install(TARGETS ols-sim ols-sim-ptu RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR}
        COMPONENT simulator EXCLUDE_FROM_ALL)
install(DIRECTORY sim/scenarios DESTINATION ${CMAKE_INSTALL_DATADIR}/ols
        COMPONENT simulator EXCLUDE_FROM_ALL)
add_dependencies(shipped ols-sim ols-sim-ptu)

# Nor is the Python module: --component python.
if(OLS_PYTHON)
  install(TARGETS ols_python LIBRARY DESTINATION ${OLS_PYTHON_INSTALL_DIR}/ols
          COMPONENT python EXCLUDE_FROM_ALL)
  install(FILES tools/python/ols/__init__.py tools/python/ols/frames.py DESTINATION ${OLS_PYTHON_INSTALL_DIR}/ols
          COMPONENT python EXCLUDE_FROM_ALL)
  install(DIRECTORY ${CMAKE_BINARY_DIR}/python/ols_msg DESTINATION ${OLS_PYTHON_INSTALL_DIR}
          COMPONENT python EXCLUDE_FROM_ALL FILES_MATCHING PATTERN "*.py")
  # They need what requirements-archive.txt names, which Debian does not have (docs/archive.md).
  install(DIRECTORY tools/python/ols_archive tools/python/ols_batch
          DESTINATION ${OLS_PYTHON_INSTALL_DIR}
          COMPONENT python EXCLUDE_FROM_ALL FILES_MATCHING PATTERN "*.py")
  install(DIRECTORY lcmtypes/ DESTINATION ${OLS_PYTHON_INSTALL_DIR}/ols_lcmtypes
          COMPONENT python EXCLUDE_FROM_ALL FILES_MATCHING PATTERN "*.lcm")
  install(FILES requirements-archive.txt DESTINATION ${CMAKE_INSTALL_DATADIR}/ols
          COMPONENT python EXCLUDE_FROM_ALL)
  add_dependencies(shipped ols_python ols_lcm_generate)
endif()

install(PROGRAMS systemd/ols-bus-route systemd/ols-console-certificate systemd/ols-keep-packages
                 systemd/ols-station-restart tools/maps/ols-map-import
        DESTINATION ${CMAKE_INSTALL_BINDIR})
install(DIRECTORY systemd/units/ DESTINATION ${OLS_SYSTEM_LIBDIR}/systemd/system)
install(DIRECTORY systemd/modules-load.d systemd/sysusers.d systemd/tmpfiles.d systemd/sysctl.d
        DESTINATION ${OLS_SYSTEM_LIBDIR})
install(DIRECTORY systemd/udev/ DESTINATION ${OLS_SYSTEM_LIBDIR}/udev/rules.d)
install(DIRECTORY tools/exporter/prometheus tools/exporter/grafana
        DESTINATION ${CMAKE_INSTALL_DATADIR}/ols/monitoring)
install(DIRECTORY systemd/examples/ DESTINATION ${CMAKE_INSTALL_DATADIR}/ols/examples)
# As in the tree, docs/ below README.md, so that links work in both (tests/lint/test_docs.py).
install(FILES README.md CONTRIBUTING.md LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/ols)
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/ols)
