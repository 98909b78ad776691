# Writes OUTPUT, which defines devlearn::version() and devlearn::commit(); rewrites it only when
# its text changes.
execute_process(COMMAND git -C ${SOURCE_DIR} describe --always --dirty --abbrev=12 --match=v*
                OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET
                RESULT_VARIABLE failed)
if(failed OR NOT EXISTS ${SOURCE_DIR}/.git)
  set(commit "unknown")
endif()
set(text "#include \"devlearn/version.hpp\"

const char* devlearn::version() noexcept { return \"${VERSION}\"; }
const char* devlearn::commit() noexcept { return \"${commit}\"; }
")
if(EXISTS ${OUTPUT})
  file(READ ${OUTPUT} before)
endif()
if(NOT "${before}" STREQUAL "${text}")
  file(WRITE ${OUTPUT} "${text}")
endif()
