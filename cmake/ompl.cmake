# Gives the target ompl::ompl. A package that exports it is taken as it is (OMPL 1.6 and later, 2.x);
# Debian's libompl-dev 1.5 tells include folders and libraries only, so the target is made of those.
find_package(ompl QUIET)
if(NOT TARGET ompl::ompl)
  find_package(Boost REQUIRED COMPONENTS serialization)
  find_path(OMPL_INCLUDE_DIR ompl/config.h PATH_SUFFIXES ompl-1.5 HINTS ${OMPL_INCLUDE_DIRS} REQUIRED)
  find_library(OMPL_LIBRARY ompl HINTS ${OMPL_LIBRARY_DIRS} REQUIRED)
  add_library(ompl::ompl UNKNOWN IMPORTED)
  set_target_properties(
    ompl::ompl PROPERTIES IMPORTED_LOCATION "${OMPL_LIBRARY}" INTERFACE_INCLUDE_DIRECTORIES
                          "${OMPL_INCLUDE_DIR}" INTERFACE_LINK_LIBRARIES
                          "Boost::boost;Boost::serialization;Eigen3::Eigen")
endif()
