#pragma once

#include "ao/conformance/reference.hpp"
#include "ao/picture.hpp"
#include "ao/temporal.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace ao::tools {

// What a frame did with the histories of the pixels that show a surface.
struct frame_facts {
    std::size_t surface = 0;   // pixels
    std::size_t converged = 0; // of which the weight is w_max after the frame
    std::size_t dropped = 0;   // that began anew: nothing was known of the surface there
    std::size_t cut = 0;       // that weigh less after the frame than what was known of them and the new samples together
    std::uint64_t samples = 0; // taken
    // Over the pixels that were neither dropped nor cut: mean of |v - v of the frame before at the pixel where the surface was|.
    std::optional<double> flicker;
    std::optional<double> flicker_p99;
};

// Follows the histories of a temporal executor from outside, by the functions that the executor itself runs.
class history_watch {
public:
    explicit history_watch(const temporal_plan& p);

    struct frame {
        // What the executor was given.
        const picture& depth;
        const picture& normal;
        const picture& motion;
        const temporal_camera& camera;
        bool cut = false;
        // What it answered.
        std::vector<std::uint32_t> history;
        std::span<const float> visibility;
    };
    // Precondition: all frames in order, of the plan's size; the executor accepted them.
    frame_facts look(frame now);

    // 1 where the last frame shows a surface.
    [[nodiscard]] const std::vector<std::uint8_t>& surface() const { return surface_; }
    // After the last frame.
    [[nodiscard]] const std::vector<std::uint32_t>& history() const { return history_; }

private:
    struct resources;
    // What became of a pixel's history.
    enum class fate : std::uint8_t { background, dropped, cut, kept };
    struct pixel_facts {
        fate is = fate::background;
        bool converged = false;
        int samples = 0;
        std::size_t from = 0; // the pixel of the last frame
    };

    void make_eye_depth(const temporal_step* linearize, const picture& depth);
    template <class Pass>
    pixel_facts look_at(Pass& pass, const typename Pass::ao_temporal_constants& c, glm::ivec2 pixel,
                        std::span<const std::uint32_t> after) const;
    [[nodiscard]] math<float>::ao_history unpacked(std::span<const std::uint32_t> words, std::size_t pixel) const;
    [[nodiscard]] std::vector<pixel_facts> standing() const;
    [[nodiscard]] std::vector<pixel_facts> accumulated(const temporal_step& step, const frame& now) const;

    temporal_plan plan_;
    temporal_state state_;
    conformance::values<float> depth_; // as stored, then eye depth
    conformance::values<float> normal_;
    conformance::values<float> motion_;
    std::vector<std::uint32_t> history_;
    std::vector<std::uint8_t> surface_;
    std::vector<float> visibility_;
};

} // namespace ao::tools
