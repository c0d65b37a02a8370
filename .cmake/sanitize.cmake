# Address and undefined-behaviour sanitizers with assertions, for the unit and property tests.
include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)
set(CMAKE_BUILD_TYPE Debug CACHE STRING "")
set(CMAKE_CXX_FLAGS_DEBUG "-O1 -g -D_GLIBCXX_ASSERTIONS" CACHE STRING "")
set(VANTAGE_SANITIZE address,undefined CACHE STRING "")
set(VANTAGE_BUILD_APPS OFF CACHE BOOL "") # its tests are not among those that run here
