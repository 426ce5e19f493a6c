# Writes a file of CTest in which each suite of unit tests is a test: one by one, they would take twice as long, for what the
# tests of a suite share, they'd prepare each on its own. Suites with names that end with Thorough are left out by tests/run.sh
# without --all. Run after each build of the tests:
#   cmake -DTESTS=PROGRAM -DOUTPUT=FILE -P list_suites.cmake
execute_process(COMMAND ${TESTS} --gtest_list_tests OUTPUT_VARIABLE listed COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "(^|\n)[^ \n]+[.]" suites "${listed}")  # their tests are indented
set(lines "")
foreach(suite ${suites})
    string(REGEX REPLACE "[\n.]" "" suite "${suite}")
    string(APPEND lines "add_test([=[unit.${suite}]=] [=[${TESTS}]=] [=[--gtest_filter=${suite}.*]=] --gtest_brief=1)\n")
    if(suite MATCHES "Thorough(/|$)")
        string(APPEND lines "set_tests_properties([=[unit.${suite}]=] PROPERTIES LABELS thorough)\n")
    endif()
endforeach()
file(WRITE ${OUTPUT} "${lines}")
