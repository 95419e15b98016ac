# What the program reads of its own (app/io/share_files.h), by name in the source tree: installed beside it.
set(regoplan_shared_files
    examples/scenario.yaml
    scenarios/demo/soils.yaml
    scenarios/drive/sensors_a.yaml
    scenarios/drive/sensors_b.yaml)

# install_shared_files(folder [option of install]...): into the folder, under their names.
function(install_shared_files folder)
  foreach(file ${regoplan_shared_files})
    get_filename_component(beneath ${file} DIRECTORY)
    install(FILES ${PROJECT_SOURCE_DIR}/${file} DESTINATION ${folder}/${beneath} ${ARGN})
  endforeach()
endfunction()
