#include "ao/cpu/rasterizer.hpp"

#include "raster_setup.hpp"
#include "raster_tile.hpp"
#include "threads.hpp"
#include "views.hpp"

#include <new>
#include <stdexcept>
#include <utility>

namespace ao::cpu {

raster_model::raster_model(std::unique_ptr<raster_model_state> state) : state_(std::move(state)) {}
raster_model::raster_model(raster_model&&) noexcept = default;
raster_model& raster_model::operator=(raster_model&&) noexcept = default;
raster_model::~raster_model() = default;

raster_targets::raster_targets(std::unique_ptr<raster_targets_state> state) : state_(std::move(state)) {}
raster_targets::raster_targets(raster_targets&&) noexcept = default;
raster_targets& raster_targets::operator=(raster_targets&&) noexcept = default;
raster_targets::~raster_targets() = default;

rasterizer::rasterizer(std::unique_ptr<detail::threads> workers) : workers_(std::move(workers)) {}
rasterizer::rasterizer(rasterizer&&) noexcept = default;
rasterizer& rasterizer::operator=(rasterizer&&) noexcept = default;
rasterizer::~rasterizer() = default;

result<rasterizer> rasterizer::create(const options& o)
{
    auto workers = detail::make_threads(o);
    if (!workers) {
        return workers.error();
    }
    return rasterizer(std::move(*workers));
}

namespace {

// Larger tiles than asked for where there would be very many: each batch counts its triangles by tile.
tile_grid make_grid(const gbuffer_facts& f, int width, int height)
{
    constexpr int most_tiles = 4096;
    tile_grid g{ std::min(width, f.width), std::min(height, f.height), 0, 0 };
    for (;;) {
        g.columns = (f.width + g.width - 1) / g.width;
        g.rows = (f.height + g.height - 1) / g.height;
        if (g.columns <= most_tiles / g.rows) {
            return g;
        }
        (g.width <= g.height && g.columns > 1 ? g.width : g.height) *= 2;
    }
}

} // namespace

result<raster_targets> rasterizer::bind(model& loaded, const gbuffer_images<image>& images)
{
    const raster_model_state& m = *loaded.state_;
    const gbuffer_facts& f = m.facts;
    struct expected {
        const image_view& view;
        const char* name;
        pixel_format format;
        bool wanted;
    };
    const expected all[] = {
        { images.depth, "depth", f.depth_format, true },
        { images.position, "position", f.position_format, f.position },
        { images.normal, "normal", f.normal_format, f.normal },
        { images.motion, "motion", f.motion_format, f.motion },
        { images.ids, "ids", pixel_format::rg32ui, f.ids },
        { images.surface, "surface", pixel_format::rgba32f, f.surface },
        { images.frame, "frame", pixel_format::rgba32f, f.frame },
    };
    for (const expected& each : all) {
        if (each.wanted) {
            if (const auto wrong = detail::unfit(each.view, f.width, f.height, each.format, each.name)) {
                return *wrong;
            }
        }
    }
    try {
        auto state = std::make_unique<raster_targets_state>();
        state->images = images;
        state->grid = make_grid(f, workers_->tile_width, workers_->tile_height);
        state->bins.resize(m.batches.size() - 1);
        state->scratch.resize(static_cast<std::size_t>(workers_->count()));
        for (tile_memory& each : state->scratch) {
            const std::size_t pixels = static_cast<std::size_t>(state->grid.width) * static_cast<std::size_t>(state->grid.height);
            each.keys.resize(pixels);
            each.triangles.resize(pixels);
        }
        return raster_targets(std::move(state));
    } catch (const std::bad_alloc&) {
        return error(errc::out_of_memory, "no memory for the tiles");
    } catch (const std::length_error&) {
        return error(errc::out_of_memory, "tiles larger than any memory");
    }
}

void rasterizer::record(commands, model& loaded, targets& bound, const gbuffer_camera& camera)
{
    const raster_model_state& m = *loaded.state_;
    raster_targets_state& t = *bound.state_;
    const raster_view view(camera, m.facts);
    const raster_frame frame(m, view);
    workers_->over(static_cast<int>(t.bins.size()), [&](int first, int last) {
        for (int i = first; i < last; ++i) {
            const auto batch = static_cast<std::size_t>(i);
            set_up_batch(m, view, batch, t.grid, t.bins[batch]);
        }
    });
    workers_->over(t.grid.count(), [&](int first, int last) {
        for (int i = first; i < last; ++i) {
            draw_tile(frame, t, i, t.scratch[workers_->own_index()]);
        }
    });
}

} // namespace ao::cpu
