// Boxes of a tree, as rays meet them.

AO_CONST int ao_bake_stack = 64; // bake_tree::max_depth

// Boxes grow by this, units: the lattice moves a point by less than 2^-21, frames of float lines stray by less than 2^-21 over
// the mesh, and a quotient's rounding moves a face of a box by less than 2^-20, on GPUs as well.
AO_CONST real ao_bake_margin = real(7.62939453125e-6); // 2^-17

struct ao_bake_box {
    vec3 low;
    vec3 high;
    int first; // triangle of a leaf, or left child; the right one follows
    int count; // triangles, 0 for inner nodes
};

// Distances to boxes round. (A function: glslang takes for ever where what is precise depends on itself around a loop.)
AO_FN real ao_bake_beyond(real distance)
{
    AO_PRECISE real beyond = distance + ao_bake_margin;
    return beyond;
}
