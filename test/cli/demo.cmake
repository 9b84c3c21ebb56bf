# Has the program make, reduce and judge a mesh in FOLDER, as ./demo does: a small one, since sanitizers make it slow.
function(run)
  execute_process(COMMAND ${PROGRAM} ${ARGN} WORKING_DIRECTORY ${FOLDER} COMMAND_ERROR_IS_FATAL ANY)
endfunction()
file(MAKE_DIRECTORY ${FOLDER})
run(generate sheets -o sheets.obj --faces 300 --layers 2)
run(simplify sheets.obj -o reduced.obj --ratio 0.4 --html report.html)
run(verify reduced.obj --against sheets.obj)
