# libFuzzer with the address and undefined-behaviour sanitizers, for the targets of tests/fuzz.
include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)
set(CMAKE_C_COMPILER clang-14 CACHE STRING "")
set(CMAKE_CXX_COMPILER clang++-14 CACHE STRING "")
set(CMAKE_BUILD_TYPE Debug CACHE STRING "")
set(CMAKE_CXX_FLAGS_DEBUG "-O1 -g" CACHE STRING "")
set(VANTAGE_FUZZ ON CACHE BOOL "")
set(VANTAGE_SANITIZE fuzzer-no-link,address,undefined CACHE STRING "")
set(VANTAGE_BUILD_APPS OFF CACHE BOOL "")
