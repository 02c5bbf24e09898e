#include "raster_tile.hpp"

#include "raster_coverage.hpp"
#include "raster_store.hpp"

#include <array>
#include <cstdint>

namespace ao::cpu {

namespace {

class tile_painter {
public:
    tile_painter(const raster_frame& frame, const raster_targets_state& targets, int index, tile_memory& memory)
        : frame_(frame),
          targets_(targets),
          memory_(memory)
    {
        const tile_grid& g = targets.grid;
        const gbuffer_facts& f = frame.model.facts;
        box_.left = index % g.columns * g.width;
        box_.top = index / g.columns * g.height;
        box_.right = std::min(box_.left + g.width, f.width);
        box_.bottom = std::min(box_.top + g.height, f.height);
    }

    void clear()
    {
        const raster_view& v = frame_.view;
        const float far_key = depth_key(frame_.model.facts.depth_format, v.key_sign, static_cast<double>(v.far_end * v.key_sign));
        std::fill(memory_.keys.begin(), memory_.keys.end(), far_key);
        std::fill(memory_.triangles.begin(), memory_.triangles.end(), nullptr);
    }

    void cover(const raster_triangle& t)
    {
        const bool cut = frame_.model.variants[frame_.model.objects[t.slot].variant].alpha_map;
        if (cut) {
            return cover_cut(t);
        }
        if (frame_.model.facts.depth_format == pixel_format::d24) {
            return cover_if<true>(t, [](int, int) { return true; });
        }
        cover_if<false>(t, [](int, int) { return true; });
    }

    void store()
    {
        for (int y = box_.top; y < box_.bottom; ++y) {
            const std::size_t start = row_start(y);
            const raster_triangle* const* shown = memory_.triangles.data() + start;
            store_depth(frame_.view, targets_.images.depth, { y, box_.left, box_.right }, memory_.keys.data() + start);
            for (int x = box_.left; x < box_.right;) {
                const raster_triangle* t = shown[x - box_.left];
                row_span span{ y, x, x + 1 };
                while (span.last < box_.right && shown[span.last - box_.left] == t) {
                    ++span.last;
                }
                if (t == nullptr) {
                    store_background(frame_.model.facts, targets_.images, span);
                }
                else {
                    store_surface(frame_, targets_.images, surface_of(*t), span);
                }
                x = span.last;
            }
        }
    }

private:
    std::size_t row_start(int y) const
    {
        return static_cast<std::size_t>(y - box_.top) * static_cast<std::size_t>(targets_.grid.width);
    }

    void cover_cut(const raster_triangle& t)
    {
        const raster_surface surface(frame_, t);
        raster_pass pass = surface.pass(frame_);
        const std::uint32_t leaf = surface.object().instance.leaf;
        const auto shows = [&](int x, int y) { return !pass.ao_geometry_cut(leaf, surface.place(x, y, surface.weights(x, y))); };
        if (frame_.model.facts.depth_format == pixel_format::d24) {
            cover_if<true>(t, shows);
        }
        else {
            cover_if<false>(t, shows);
        }
    }

    template <bool D24, class Shows>
    void cover_if(const raster_triangle& t, Shows shows)
    {
        const double least = static_cast<double>(t.least);
        const double greatest = static_cast<double>(t.greatest);
        const float sign = frame_.view.key_sign;
        for_rows(t, box_.left, box_.top, box_.right, box_.bottom, [&](int y, int first, int last) {
            const std::size_t start = row_start(y);
            const double along = t.depth_y * y + t.depth_0;
            for (int x = first; x <= last; ++x) {
                const std::size_t i = start + static_cast<std::size_t>(x - box_.left);
                const double exact = std::min(std::max(t.depth_x * x + along, least), greatest);
                const float key = D24 ? depth_key(pixel_format::d24, sign, exact) : depth_key(pixel_format::d32f, sign, exact);
                if (key < memory_.keys[i] && shows(x, y)) {
                    memory_.keys[i] = key;
                    memory_.triangles[i] = &t;
                }
            }
        });
    }

    // Kept, since the pixels of a triangle lie close together.
    const raster_surface& surface_of(const raster_triangle& t)
    {
        const auto address = reinterpret_cast<std::uintptr_t>(&t) / sizeof(raster_triangle);
        raster_surface& s = kept_[address % kept_.size()];
        if (s.triangle() != &t) {
            s = raster_surface(frame_, t);
        }
        return s;
    }

    const raster_frame& frame_;
    const raster_targets_state& targets_;
    tile_memory& memory_;
    detail::tile box_;
    std::array<raster_surface, 64> kept_;
};

} // namespace

void draw_tile(const raster_frame& frame, const raster_targets_state& targets, int index, tile_memory& memory)
{
    tile_painter painter(frame, targets, index, memory);
    painter.clear();
    for (const triangle_bins& bins : targets.bins) {
        const std::uint32_t last = bins.starts[static_cast<std::size_t>(index) + 1];
        for (std::uint32_t i = bins.starts[static_cast<std::size_t>(index)]; i < last; ++i) {
            painter.cover(bins.triangles[bins.sorted[i]]);
        }
    }
    painter.store();
}

} // namespace ao::cpu
