# Puts files into a program: regoplan_embed(target header NAME file... [NAME file...]) defines, at
# build time, each std::string_view that the header declares as the files that follow its name, one
# after the other. Names begin with k.
function(regoplan_embed target header)
  set(output ${PROJECT_BINARY_DIR}/embedded/${target}.cpp)
  set(files ${ARGN})
  list(FILTER files EXCLUDE REGEX "^k[A-Z][A-Za-z0-9]*$")
  add_custom_command(
    OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -DOUTPUT=${output} -DHEADER=${header} "-DASSETS=${ARGN}" -P
            ${PROJECT_SOURCE_DIR}/cmake/embed.cmake
    WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}
    DEPENDS ${files} ${PROJECT_SOURCE_DIR}/cmake/embed.cmake
    VERBATIM)
  target_sources(${target} PRIVATE ${output})
  set_source_files_properties(${output} PROPERTIES SKIP_PRECOMPILE_HEADERS ON)
endfunction()

if(NOT CMAKE_SCRIPT_MODE_FILE)
  return()
endif()

file(WRITE ${OUTPUT} "#include \"${HEADER}\"\n\nnamespace regoplan::report_assets {\n")
set(open FALSE)
foreach(asset ${ASSETS})
  if(asset MATCHES "^k[A-Z][A-Za-z0-9]*$")
    if(open)
      file(APPEND ${OUTPUT} ";\n")
    endif()
    file(APPEND ${OUTPUT} "extern const std::string_view ${asset} = \"\"\n")
    set(open TRUE)
  else()
    file(READ ${asset} text)
    file(APPEND ${OUTPUT} "R\"~embedded~(${text})~embedded~\"\n")
  endif()
endforeach()
file(APPEND ${OUTPUT} ";\n}  // namespace regoplan::report_assets\n")
