# Debian's libompl-dev exports no CMake target of its own, so it is named here.
find_path(OMPL_INCLUDE_DIR ompl/config.h PATH_SUFFIXES ompl-1.5 REQUIRED)
find_library(OMPL_LIBRARY ompl REQUIRED)
find_package(Boost REQUIRED COMPONENTS serialization)
add_library(ompl::ompl UNKNOWN IMPORTED)
set_target_properties(
  ompl::ompl PROPERTIES IMPORTED_LOCATION "${OMPL_LIBRARY}" INTERFACE_INCLUDE_DIRECTORIES
                        "${OMPL_INCLUDE_DIR}" INTERFACE_LINK_LIBRARIES
                        "Boost::boost;Boost::serialization;Eigen3::Eigen")
