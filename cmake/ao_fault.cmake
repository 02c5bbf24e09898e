# ao_fault(out file name "right" "wrong"): sets `out`, the text of a source, to that with one text replaced by a faulty one.
# The right text must occur once, so that the fault called `name` cannot get lost when the source changes.
function(ao_fault out file name right wrong)
    set(text "${${out}}")
    string(FIND "${text}" "${right}" first)
    string(FIND "${text}" "${right}" last REVERSE)
    if(first EQUAL -1 OR NOT first EQUAL last)
        message(FATAL_ERROR "${file}: \"${right}\" does not occur once; plant the fault \"${name}\" elsewhere")
    endif()
    string(REPLACE "${right}" "${wrong}" text "${text}")
    set(${out} "${text}" PARENT_SCOPE)
endfunction()
