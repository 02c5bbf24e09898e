// Callbacks of temporal_pass.h that only C++ has faster ways for. Requires: ao_load_depth, ao_load_history.
#include "ao/shared/history_row.h"

real ao_load_own_depth(ivec2 pixel)
{
    return ao_load_depth(pixel);
}

ao_history_row ao_load_history_row(uint first, uint second, uint third, uint fourth)
{
    return ao_history_row(ao_load_history(first), ao_load_history(second), ao_load_history(third), ao_load_history(fourth));
}
