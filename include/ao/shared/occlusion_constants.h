// What the passes that estimate visibility from a depth buffer are told of a frame.

struct ao_occlusion_constants {
    ao_projection projection;
    ao_rotation normal_to_view;
    real radius;         // scene units
    real bias;           // delta of paper 1, scene units
    real bias_linear;    // what the depth's storage adds to it: bias + d * (linear + d * quadratic)
    real bias_quadratic; // 1 / scene unit
    real thickness;      // how far behind a surface an offset may lie and still be occluded, scene units
    real background;     // eye depths from here on are background, at most 1e30
    real width;          // pixels
    real height;
};
