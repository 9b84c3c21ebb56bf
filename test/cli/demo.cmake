# Has the program make, reduce and judge a garment in FOLDER, as ./demo does.
function(run)
  execute_process(COMMAND ${PROGRAM} ${ARGN} WORKING_DIRECTORY ${FOLDER} COMMAND_ERROR_IS_FATAL ANY)
endfunction()
file(MAKE_DIRECTORY ${FOLDER})
run(generate skirt -o skirt.obj --faces 5000 --layers 3)
run(simplify skirt.obj -o reduced.obj --ratio 0.2 --html report.html)
run(verify reduced.obj --against skirt.obj)
