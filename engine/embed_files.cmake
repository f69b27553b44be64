# SPDX-License-Identifier: MIT
# halfshadow_embed(TABLE FOLDER PATTERN...): TABLE, a file in the build folder, gets one `{"path", R"(text)"},` line for
# each file below FOLDER that matches; it is written anew when one of them changes, comes or goes.
function(halfshadow_embed table folder)
  list(TRANSFORM ARGN PREPEND ${folder}/ OUTPUT_VARIABLE patterns)
  file(GLOB_RECURSE files CONFIGURE_DEPENDS ${patterns})
  add_custom_command(
    OUTPUT ${table}
    COMMAND ${CMAKE_COMMAND} -DFOLDER=${folder} "-DPATTERNS=${patterns}" -DOUTPUT=${table} -P ${CMAKE_CURRENT_FUNCTION_LIST_FILE}
    DEPENDS ${files} ${CMAKE_CURRENT_FUNCTION_LIST_FILE} ${folder}
    COMMENT "Embedding the files of ${folder}"
    VERBATIM)
endfunction()

if(CMAKE_SCRIPT_MODE_FILE AND OUTPUT)
  file(GLOB_RECURSE files RELATIVE ${FOLDER} ${PATTERNS})
  list(SORT files)
  file(WRITE ${OUTPUT}.tmp "")
  foreach(name IN LISTS files)
    file(READ ${FOLDER}/${name} text)
    file(APPEND ${OUTPUT}.tmp "{\"${name}\", R\"HS_FILE(${text})HS_FILE\"},\n")
  endforeach()
  file(RENAME ${OUTPUT}.tmp ${OUTPUT})
endif()
