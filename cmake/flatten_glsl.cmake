# ao_flatten_glsl(out source include_dirs defines): the text of a shader for drivers that know neither #include nor
# SPIR-V. Includes are replaced by what they name, wherever the preprocessor will then find them active or not;
# comments go (they may hold characters that a driver's lexer refuses). The first line is #version.

function(_ao_expand_includes out file include_dirs depth)
    if(depth GREATER 32)
        message(FATAL_ERROR "${file}: includes nest deeper than 32, or in a circle")
    endif()
    file(READ "${file}" text)
    string(REPLACE "\r\n" "\n" text "${text}")
    # A file that ends in its last token must not run into the line behind the include.
    string(APPEND text "\n")
    string(REGEX REPLACE "/\\*([^*]|\\*+[^*/])*\\*+/" " " text "${text}")
    string(REGEX REPLACE "[ \t]*//[^\n]*" "" text "${text}")
    set(done "")
    while(text MATCHES "(^|\n)[ \t]*#[ \t]*include[ \t]*([\"<])([^\">\n]+)[\">][^\n]*")
        set(line "${CMAKE_MATCH_0}")
        set(before "${CMAKE_MATCH_1}")
        set(quote "${CMAKE_MATCH_2}")
        set(name "${CMAKE_MATCH_3}")
        string(FIND "${text}" "${line}" at)
        string(LENGTH "${line}" length)
        string(SUBSTRING "${text}" 0 ${at} head)
        math(EXPR rest "${at} + ${length}")
        string(SUBSTRING "${text}" ${rest} -1 text)

        cmake_path(GET file PARENT_PATH own_dir)
        set(found "")
        foreach(dir IN LISTS own_dir include_dirs)
            if(EXISTS "${dir}/${name}")
                set(found "${dir}/${name}")
                break()
            endif()
        endforeach()
        set(body "")
        if(found)
            math(EXPR deeper "${depth} + 1")
            _ao_expand_includes(body "${found}" "${include_dirs}" ${deeper})
        elseif(quote STREQUAL "\"")
            message(FATAL_ERROR "${file}: cannot find \"${name}\" in ${include_dirs}")
        endif()
        # <header> that is not found belongs to the C++ side of an #ifdef __cplusplus.
        string(APPEND done "${head}${before}${body}")
    endwhile()
    set(${out} "${done}${text}" PARENT_SCOPE)
endfunction()

function(ao_flatten_glsl out source include_dirs defines)
    _ao_expand_includes(text "${source}" "${include_dirs}" 0)

    string(REGEX MATCH "#[ \t]*version[ \t]+([0-9]+[^\n]*)" version "${text}")
    if(NOT version)
        message(FATAL_ERROR "${source}: no #version")
    endif()
    set(version "${CMAKE_MATCH_1}")
    string(REGEX REPLACE "#[ \t]*version[^\n]*" "" text "${text}")
    string(REGEX REPLACE "#[ \t]*extension[ \t]+GL_GOOGLE_[^\n]*" "" text "${text}")
    string(REGEX REPLACE "#[ \t]*(line|pragma[ \t]+once)[^\n]*" "" text "${text}")

    string(REGEX REPLACE
        "layout[ \t]*\\([ \t]*constant_id[ \t]*=[ \t]*([0-9]+)[ \t]*\\)[ \t\n]*const[ \t\n]+([a-z]+)[ \t\n]+([A-Za-z_0-9]+)[ \t\n]*=[ \t\n]*([^;]+);"
        "\n#ifndef AO_SPEC_\\1\n#define AO_SPEC_\\1 \\4\n#endif\nconst \\2 \\3 = \\2(AO_SPEC_\\1);"
        text "${text}")
    string(REGEX REPLACE "local_size_([xyz])_id[ \t]*=[ \t]*([0-9]+)" "local_size_\\1 = AO_SPEC_\\2" text "${text}")
    if(text MATCHES "constant_id")
        message(FATAL_ERROR "${source}: a constant_id that has no counterpart in plain GLSL; write it as "
                            "layout(constant_id = N) const TYPE NAME = VALUE;")
    endif()

    set(define_lines "")
    foreach(define IN LISTS defines)
        string(REGEX REPLACE "=" " " define "${define}")
        string(APPEND define_lines "#define ${define}\n")
    endforeach()
    string(REGEX REPLACE "[ \t]+\n" "\n" text "${text}")
    string(REGEX REPLACE "\n\n+" "\n" text "${text}")
    string(REGEX REPLACE "^\n" "" text "${text}")
    set(${out} "#version ${version}\n${define_lines}${text}" PARENT_SCOPE)
endfunction()
