// The words of four pixels' histories, what ao_load_history_row (temporal_pass.h) returns.

struct ao_history_row {
    uvec4 first;
    uvec4 second;
    uvec4 third;
    uvec4 fourth;
};
