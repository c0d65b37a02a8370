# For find_package(Vantage): gives the target Vantage::Filters.
include(CMakeFindDependencyMacro)
find_dependency(VTK COMPONENTS CommonCore CommonDataModel CommonExecutionModel IOXML RenderingCore)
include(${CMAKE_CURRENT_LIST_DIR}/Vantage-targets.cmake)
include(${CMAKE_CURRENT_LIST_DIR}/Vantage-vtk-module-properties.cmake)
