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

// All targets but depth, at a pixel that shows the surface.
void store_surface(const raster_frame& frame, const gbuffer_images<image_view>& to, const raster_surface& surface, int x, int y);

// All targets but depth, at a pixel that shows nothing.
void store_background(const gbuffer_facts& f, const gbuffer_images<image_view>& to, int x, int y);

void store_depth(const raster_view& view, const image_view& to, int x, int y, float key);

} // namespace ao::cpu
