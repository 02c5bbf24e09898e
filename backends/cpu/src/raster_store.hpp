// Writing of targets.
#pragma once

#include "raster_fragments.hpp"
#include "views.hpp"

namespace ao::cpu {

// Depth as the depth test sees it: what the depth buffer holds times raster_view::key_sign. `key` in [0, 1] times that.
inline float depth_key(pixel_format format, float sign, double key)
{
    if (format == pixel_format::d24) {
        const double s = static_cast<double>(sign);
        return static_cast<float>(s * math<double>::ao_unorm_code(key * s, 16777215.0));
    }
    return static_cast<float>(key);
}

// Pixels first ... last - 1 of a row.
struct row_span {
    int y = 0;
    int first = 0;
    int last = 0;
};

// All targets but depth, where the surface is seen.
void store_surface(const raster_frame& frame, const gbuffer_images<image_view>& to, const raster_surface& surface,
                   const row_span& span);

// All targets but depth, where nothing is seen.
void store_background(const gbuffer_facts& f, const gbuffer_images<image_view>& to, const row_span& span);

// `keys`: of the span's pixels.
void store_depth(const raster_view& view, const image_view& to, const row_span& span, const float* keys);

} // namespace ao::cpu
