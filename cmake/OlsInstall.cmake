# `cmake --install BUILD --prefix /usr` (DESTDIR is honoured): programs, units and what they need,
# examples, documents. The units find the programs in /usr/bin and /usr/local/bin.
include(GNUInstallDirs)

# Outside lib/<architecture>: systemd and udev look there.
set(OLS_SYSTEM_LIBDIR lib)

foreach(program IN ITEMS ols-station ols-fusion ols-ctl ols-doctor ols-logger ols-track ols-fuse
                         ols-precision ols-stationing ols-calibrate)
  install(TARGETS ${program} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endforeach()
# The simulator is not installed by default: cmake --install BUILD --component simulator.
install(TARGETS ols-sim ols-sim-ptu RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR}
        COMPONENT simulator EXCLUDE_FROM_ALL)
install(DIRECTORY sim/scenarios DESTINATION ${CMAKE_INSTALL_DATADIR}/ols
        COMPONENT simulator EXCLUDE_FROM_ALL)

install(PROGRAMS systemd/ols-bus-route DESTINATION ${CMAKE_INSTALL_BINDIR})
install(DIRECTORY systemd/units/ DESTINATION ${OLS_SYSTEM_LIBDIR}/systemd/system)
install(DIRECTORY systemd/modules-load.d systemd/sysusers.d systemd/tmpfiles.d systemd/sysctl.d
        DESTINATION ${OLS_SYSTEM_LIBDIR})
install(DIRECTORY systemd/udev/ DESTINATION ${OLS_SYSTEM_LIBDIR}/udev/rules.d)
install(DIRECTORY systemd/examples/ DESTINATION ${CMAKE_INSTALL_DATADIR}/ols/examples)
# As in the tree, docs/ below README.md, so that links work in both (tests/lint/test_docs.py).
install(FILES README.md CONTRIBUTING.md LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/ols)
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/ols)
