# What each component needs, of the others and of packages: for the build, and for whoever finds
# regoplan installed. terramech is part of every choice.
set(regoplan_terramech_components)
set(regoplan_terramech_packages Eigen3 fmt Boost)
set(regoplan_maps_components)
set(regoplan_maps_packages GDAL)
set(regoplan_planner_components maps)
set(regoplan_planner_packages Ceres Threads fcl)  # and OMPL, by ompl.cmake
set(regoplan_diagnosis_components)
set(regoplan_diagnosis_packages Ceres Threads)
set(regoplan_app_components maps planner diagnosis)
set(regoplan_app_packages yaml-cpp nlohmann_json CLI11 SQLite3)

# regoplan_with_needs(wanted packages components...): the components with all that they need, each
# behind what it needs, and the packages of all.
function(regoplan_with_needs wanted packages)
  set(all terramech)
  foreach(component ${ARGN})
    list(APPEND all ${regoplan_${component}_components} ${component})
  endforeach()
  list(REMOVE_DUPLICATES all)
  set(found "")
  foreach(component ${all})
    list(APPEND found ${regoplan_${component}_packages})
  endforeach()
  list(REMOVE_DUPLICATES found)
  set(${wanted} ${all} PARENT_SCOPE)
  set(${packages} ${found} PARENT_SCOPE)
endfunction()
