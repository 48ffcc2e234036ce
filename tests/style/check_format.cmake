# Fails when a source file is not as .clang-format has it. FORMAT: the program; SOURCE: the tree.
file(GLOB_RECURSE files ${SOURCE}/renderer/*.cpp ${SOURCE}/renderer/*.h ${SOURCE}/server/*.cpp ${SOURCE}/server/*.h
    ${SOURCE}/tests/*.cpp ${SOURCE}/tests/*.h)
list(FILTER files EXCLUDE REGEX "node_modules")
list(LENGTH files count)
if(count LESS 100)
    message(FATAL_ERROR "only ${count} source files were found below ${SOURCE}")
endif()
execute_process(COMMAND ${FORMAT} --dry-run -Werror ${files} RESULT_VARIABLE result ERROR_VARIABLE output)
if(result)
    string(SUBSTRING "${output}" 0 4000 output)
    message(FATAL_ERROR "not formatted; run clang-format -i on these:\n${output}")
endif()
