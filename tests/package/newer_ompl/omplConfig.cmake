# Stands for the configuration that OMPL 1.6 and later install.
add_library(ompl::ompl INTERFACE IMPORTED)
set_target_properties(ompl::ompl PROPERTIES INTERFACE_INCLUDE_DIRECTORIES /of/ompl/2)
