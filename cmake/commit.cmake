# Sets `commit`; run as a script, it also writes OUTPUT, which defines devlearn::version() and
# devlearn::commit(), and rewrites it only when its text changes.
set(commit "unknown")
if(EXISTS ${SOURCE_DIR}/.git)
  execute_process(COMMAND git -C ${SOURCE_DIR} describe --always --dirty --abbrev=12 --match=v*
                  OUTPUT_VARIABLE described OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET
                  RESULT_VARIABLE failed)
  if(NOT failed)
    set(commit "${described}")
  endif()
elseif(EXISTS ${SOURCE_DIR}/COMMIT)  # a source distribution
  file(STRINGS ${SOURCE_DIR}/COMMIT commit LIMIT_COUNT 1)
endif()

if(CMAKE_SCRIPT_MODE_FILE)
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
endif()
