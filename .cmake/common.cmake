# What all the settings beside this file share. Use one of them to fill a new build folder:
#   cmake -C .cmake/release.cmake -S . -B out/build

set(CMAKE_GENERATOR Ninja CACHE INTERNAL "")
set(CMAKE_EXPORT_COMPILE_COMMANDS ON CACHE BOOL "")

# Debian's VTK is wrapped for Debian's Python, whichever else comes first on the path.
set(Python3_EXECUTABLE /usr/bin/python3 CACHE FILEPATH "")

find_program(VANTAGE_CCACHE ccache)
if(VANTAGE_CCACHE)
  set(CMAKE_CXX_COMPILER_LAUNCHER "${VANTAGE_CCACHE}" CACHE STRING "")
endif()
