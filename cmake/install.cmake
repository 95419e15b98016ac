# Installs the libraries with the headers that their umbrella header reaches, the package's
# configuration, the program with what it shares, and makes a Debian package of them (cpack -G DEB).
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
include(${CMAKE_CURRENT_LIST_DIR}/shared_files.cmake)

# public_headers(variable header): the header and all of ours that it includes, from the source root.
function(public_headers variable header)
  set(found "")
  set(open ${header})
  while(open)
    list(POP_FRONT open next)
    list(APPEND found ${next})
    set(file ${PROJECT_SOURCE_DIR}/${next})
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
    file(STRINGS ${file} lines REGEX "^#include \"[a-z_/]+/[a-z_0-9]+\\.h\"")
    foreach(line ${lines})
      string(REGEX REPLACE "^#include \"([^\"]+)\".*" "\\1" included "${line}")
      if(NOT included IN_LIST found AND NOT included IN_LIST open)
        list(APPEND open ${included})
      endif()
    endforeach()
  endwhile()
  set(${variable} ${found} PARENT_SCOPE)
endfunction()

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/regoplan)
set(app_rooms benchmarking driving drive_diagnosis)  # libraries that a component has beside its own
foreach(component ${REGOPLAN_COMPONENTS})
  foreach(library ${component} ${${component}_rooms})
    set_target_properties(regoplan_${library} PROPERTIES EXPORT_NAME ${library})
    install(TARGETS regoplan_${library} EXPORT regoplan-${component}
            ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
  endforeach()
  install(EXPORT regoplan-${component} FILE regoplan-${component}.cmake NAMESPACE regoplan::
          DESTINATION ${package_folder})
  public_headers(headers ${component}/${component}.h)
  foreach(header ${headers})
    get_filename_component(folder ${header} DIRECTORY)
    install(FILES ${PROJECT_SOURCE_DIR}/${header}
            DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/regoplan/${folder})
  endforeach()
endforeach()
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/regoplanConfig.cmake.in
                              ${PROJECT_BINARY_DIR}/regoplanConfig.cmake
                              INSTALL_DESTINATION ${package_folder})
# Semantic versions; before 1.0 a minor version may break.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/regoplanConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/regoplanConfig.cmake
              ${PROJECT_BINARY_DIR}/regoplanConfigVersion.cmake
              ${PROJECT_SOURCE_DIR}/cmake/components.cmake
              ${PROJECT_SOURCE_DIR}/cmake/ompl.cmake
        DESTINATION ${package_folder})

if(REGOPLAN_PROGRAM)
  install_shared_files(${CMAKE_INSTALL_DATADIR}/regoplan)
  # What the program says of itself: completion for two shells and, with help2man, manual pages.
  set(bash_completion ${PROJECT_BINARY_DIR}/completion/regoplan)
  set(zsh_completion ${PROJECT_BINARY_DIR}/completion/_regoplan)
  add_custom_command(
    OUTPUT ${bash_completion} ${zsh_completion}
    COMMAND ${CMAKE_COMMAND} -E make_directory ${PROJECT_BINARY_DIR}/completion
    COMMAND regoplan completion bash > ${bash_completion}
    COMMAND regoplan completion zsh > ${zsh_completion}
    DEPENDS regoplan
    VERBATIM)
  add_custom_target(regoplan_completion ALL DEPENDS ${bash_completion} ${zsh_completion})
  install(FILES ${bash_completion} DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
  install(FILES ${zsh_completion} DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions)
  find_program(HELP2MAN help2man)
  if(HELP2MAN)
    set(manuals ${PROJECT_BINARY_DIR}/manuals)
    add_custom_command(
      OUTPUT ${manuals}/regoplan.1
      COMMAND ${PROJECT_SOURCE_DIR}/cmake/manuals.sh $<TARGET_FILE:regoplan> ${PROJECT_VERSION} ${manuals}
      DEPENDS regoplan ${PROJECT_SOURCE_DIR}/cmake/manuals.sh
      VERBATIM)
    add_custom_target(regoplan_manuals ALL DEPENDS ${manuals}/regoplan.1)
    install(DIRECTORY ${manuals}/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
  endif()
  install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
  set(CPACK_GENERATOR DEB)
  set(CPACK_PACKAGE_CONTACT "the authors of regoplan <regoplan@localhost>")
  set(CPACK_PACKAGE_DESCRIPTION_SUMMARY
      "Motion-planning feasibility for wheeled vehicles on loose soil")
  set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
  # The program needs libraries only; who builds on ours needs what their headers include.
  set(CPACK_DEBIAN_PACKAGE_SUGGESTS
      "libeigen3-dev, libfmt-dev, libboost-dev, libgdal-dev, libompl-dev, libfcl-dev, libceres-dev, \
libyaml-cpp-dev, nlohmann-json3-dev, libcli11-dev, libsqlite3-dev")
  set(CPACK_DEBIAN_PACKAGE_SECTION science)
  set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
  include(CPack)
endif()
