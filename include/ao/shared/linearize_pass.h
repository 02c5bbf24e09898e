// Eye depth (R32F) from whatever depth or position the G-buffer holds; 0 marks background and unusable values.
// Callbacks: real ao_load_stored_depth(ivec2): depth buffer value, linear depth, or z of a view-space position.
// Options:   bool ao_affine (parallel projection, linear depth or position).

AO_PASS real ao_linearize_pass(ao_depth_decode c, ivec2 pixel)
{
    AO_PRECISE vec2 centre = vec2(real(pixel.x) + real(0.5), real(pixel.y) + real(0.5));
    return ao_eye_depth(c, centre, ao_load_stored_depth(pixel), ao_affine);
}
