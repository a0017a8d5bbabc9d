# Stock Debian 12 packages; tools/install-dependencies names them.

# System headers, so that their warnings are not ours.
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(OpenCV 4.6 REQUIRED COMPONENTS core imgproc calib3d videoio imgcodecs features2d)
find_package(PkgConfig REQUIRED)
pkg_check_modules(curl REQUIRED IMPORTED_TARGET libcurl)
pkg_check_modules(erfa REQUIRED IMPORTED_TARGET erfa)
pkg_check_modules(lcm REQUIRED IMPORTED_TARGET lcm)
pkg_check_modules(glib REQUIRED IMPORTED_TARGET glib-2.0)
pkg_check_modules(aravis REQUIRED IMPORTED_TARGET aravis-0.8)
pkg_check_modules(gstreamer_server REQUIRED IMPORTED_TARGET gio-2.0 gstreamer-rtp-1.0 gstreamer-rtsp-server-1.0
                  gstreamer-sdp-1.0)
pkg_check_modules(gstreamer REQUIRED IMPORTED_TARGET gio-2.0 gstreamer-app-1.0 gstreamer-video-1.0)
pkg_check_modules(libgpiod REQUIRED IMPORTED_TARGET libgpiod)
pkg_check_modules(libgps REQUIRED IMPORTED_TARGET libgps)
pkg_check_modules(libsystemd REQUIRED IMPORTED_TARGET libsystemd)
pkg_check_modules(openh264 REQUIRED IMPORTED_TARGET openh264)
pkg_check_modules(sodium REQUIRED IMPORTED_TARGET libsodium)
pkg_check_modules(pugixml REQUIRED IMPORTED_TARGET pugixml)
pkg_check_modules(prometheus REQUIRED IMPORTED_TARGET prometheus-cpp-pull)
pkg_check_modules(tomlplusplus REQUIRED IMPORTED_TARGET tomlplusplus)
find_package(Boost 1.74 REQUIRED) # the headers of Boost.Math and Boost.Beast
find_package(benchmark REQUIRED)
find_package(CLI11 REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(spdlog REQUIRED)
find_package(Threads REQUIRED)

# Its pkg-config file names no library.
find_library(INDICLIENT_LIBRARY indiclient REQUIRED)
find_path(INDICLIENT_INCLUDE_DIR libindi/baseclient.h REQUIRED)
add_library(ols_indi_client INTERFACE)
target_link_libraries(ols_indi_client INTERFACE ${INDICLIENT_LIBRARY})
target_include_directories(ols_indi_client SYSTEM INTERFACE ${INDICLIENT_INCLUDE_DIR} ${INDICLIENT_INCLUDE_DIR}/libindi)

find_package(GDAL 3.6 REQUIRED)
add_library(ols_gdal INTERFACE)
target_link_libraries(ols_gdal INTERFACE ${GDAL_LIBRARIES})
target_include_directories(ols_gdal SYSTEM INTERFACE ${GDAL_INCLUDE_DIRS})

find_library(GeographicLib_LIBRARY NAMES GeographicLib Geographic REQUIRED)
find_path(GeographicLib_INCLUDE_DIR GeographicLib/Geocentric.hpp REQUIRED)
add_library(GeographicLib::lib INTERFACE IMPORTED)
target_link_libraries(GeographicLib::lib INTERFACE ${GeographicLib_LIBRARY})
target_include_directories(GeographicLib::lib SYSTEM INTERFACE ${GeographicLib_INCLUDE_DIR})

# An interface target for OpenCV, with its headers as system headers.
add_library(ols_opencv INTERFACE)
target_link_libraries(ols_opencv INTERFACE ${OpenCV_LIBS})
target_include_directories(ols_opencv SYSTEM INTERFACE ${OpenCV_INCLUDE_DIRS})

if(OLS_PYTHON)
  # The distribution's interpreter: the module is built for it.
  find_package(Python3 COMPONENTS Interpreter Development.Module REQUIRED)
  set(PYTHON_EXECUTABLE ${Python3_EXECUTABLE})
  find_package(pybind11 CONFIG REQUIRED)
endif()
