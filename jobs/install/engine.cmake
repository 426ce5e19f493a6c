# The engine of explore.py's page, from build/page, where it is compiled first if it is missing and can be.
message("-- The engine of explore.py's page (compiling it takes about a minute)")
execute_process(COMMAND ${python} ${sources}/jobs/install/engine_path.py ${sources}/postprocess
    RESULT_VARIABLE failed OUTPUT_VARIABLE engine ERROR_VARIABLE words)
if(failed)
    string(REGEX REPLACE "\n$" "" words "${words}")
    string(REGEX REPLACE ".*\n" "" words "${words}")
    message("-- Without it: ${words}")
else()
    file(INSTALL ${engine} DESTINATION ${engines})
endif()
