# SPDX-License-Identifier: MIT
# Writes OUTPUT: one `{"name", R"(text)"},` line per shader file below SHADER_DIR.
file(GLOB_RECURSE files RELATIVE ${SHADER_DIR} ${SHADER_DIR}/*.vert ${SHADER_DIR}/*.frag ${SHADER_DIR}/*.glsl)
list(SORT files)
file(WRITE ${OUTPUT}.tmp "")
foreach(name IN LISTS files)
  file(READ ${SHADER_DIR}/${name} text)
  file(APPEND ${OUTPUT}.tmp "{\"${name}\", R\"HSGLSL(${text})HSGLSL\"},\n")
endforeach()
file(RENAME ${OUTPUT}.tmp ${OUTPUT})
