// Compute route: one invocation a pixel. The picture is bound in whatever format it has.
layout(local_size_x_id = 9, local_size_y_id = 10) in;
layout(binding = 0) writeonly uniform image2D ao_picture;

bool ao_inside(ivec2 pixel)
{
    return all(lessThan(pixel, imageSize(ao_picture)));
}
