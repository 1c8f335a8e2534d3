# dualdamp_rooms(<target> <source>...): the sources of one room (subfolder) are compiled as one unit, so that headers are
# read and templates instantiated once for all of them. Names in their anonymous namespaces are the room's, not the file's.
function(dualdamp_rooms target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD_MODE GROUP)
  foreach(source IN LISTS ARGN)
    get_filename_component(room "${source}" DIRECTORY)
    string(MAKE_C_IDENTIFIER "room_${room}" room)
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${room})
  endforeach()
endfunction()

# dualdamp_module(<folder> HEADERS ... SOURCES ... [PAIRS ...] [PUBLIC ...] [PRIVATE ...]): the library of one folder.
# HEADERS are public: installed, and included as "<folder>/<header>"; headers of the folder's own stand among SOURCES.
# A pair ROOM/NAME stands for the public header ROOM/NAME.hpp, the source ROOM/NAME.cpp and, where the folder's tests
# say PAIRS, the test ROOM/test_NAME.cpp: one line for each law, method or analysis.
# PUBLIC and PRIVATE are what it links.
function(dualdamp_module name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "HEADERS;SOURCES;PAIRS;PUBLIC;PRIVATE")
  if(arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "dualdamp_module(${name}): unexpected ${arg_UNPARSED_ARGUMENTS}")
  endif()
  if(NOT arg_HEADERS AND NOT arg_SOURCES)
    return()  # a folder still empty
  endif()
  foreach(pair IN LISTS arg_PAIRS)
    list(APPEND arg_HEADERS ${pair}.hpp)
    list(APPEND arg_SOURCES ${pair}.cpp)
  endforeach()
  set_property(GLOBAL PROPERTY DUALDAMP_PAIRS_${name} ${arg_PAIRS})
  set(target dualdamp_${name})
  add_library(${target} STATIC)
  add_library(dualdamp::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name} LINKER_LANGUAGE CXX)
  target_sources(${target}
    PRIVATE ${arg_SOURCES}
    PUBLIC FILE_SET HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR} FILES ${arg_HEADERS})
  list(FILTER arg_SOURCES INCLUDE REGEX "\\.cpp$")
  dualdamp_rooms(${target} ${arg_SOURCES})
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_link_libraries(${target} PUBLIC ${arg_PUBLIC} PRIVATE ${arg_PRIVATE} $<BUILD_INTERFACE:dualdamp_options>)
  if(name IN_LIST DUALDAMP_BRIEF_FOLDERS)
    target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:dualdamp_brief_options>)
  endif()
  if(name IN_LIST DUALDAMP_LINK_TIME_FOLDERS)
    target_compile_options(${target} PRIVATE "$<${DUALDAMP_LINK_TIME}:-flto=auto;$<IF:$<BOOL:${DUALDAMP_FAT_OBJECTS}>,-ffat-lto-objects,-fno-fat-lto-objects>;${DUALDAMP_SHORT_LOOPS}>")
  endif()
  install(TARGETS ${target} EXPORT dualdamp FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/dualdamp)
endfunction()
