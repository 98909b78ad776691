# Looks at what the objects of the learner and of all that it steps through refer to: nothing that
# waits, locks or tells the time, and no memory but by operator new, which test_realtime.cpp counts.
cmake_minimum_required(VERSION 3.22)
set(parts choice evaluation learner math motor_memory random situation)
set(forbidden "pthread_|mutex|condition_variable|__cxa_guard|nothrow"
    "^(malloc|calloc|realloc|memalign|posix_memalign|aligned_alloc|mmap)$"
    "^(time|clock|clock_gettime|gettimeofday|sleep|usleep|nanosleep|futex|sem_wait)$")
string(REPLACE ";" "|" forbidden "${forbidden}")
set(seen "")
foreach(object IN LISTS OBJECTS)
  get_filename_component(part ${object} NAME)
  string(REGEX REPLACE "\\..*" "" part ${part})
  if(NOT part IN_LIST parts)
    continue()
  endif()
  list(APPEND seen ${part})
  execute_process(COMMAND ${NM} --undefined-only --format=posix ${object}
                  OUTPUT_VARIABLE symbols COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCHALL "[^ \n]+ U" found "${symbols}")
  list(TRANSFORM found REPLACE " U" "")
  list(FILTER found INCLUDE REGEX "${forbidden}")
  if(found)
    message(FATAL_ERROR "${object} refers to ${found}")
  endif()
endforeach()
list(SORT seen)
if(NOT seen STREQUAL parts)
  message(FATAL_ERROR "looked at ${seen}, not at ${parts}")
endif()
