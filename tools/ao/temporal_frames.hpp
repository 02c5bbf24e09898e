#pragma once

#include "ao/ray_motion.hpp"
#include "ao/scene_input.hpp"
#include "ao/temporal.hpp"
#include "ao/view.hpp"
#include "scene/ray_tree.hpp"
#include "scene/truth.hpp"

#include <optional>

namespace ao::tools {

// A frame's pictures as a temporal runner takes them; those that it does not read are empty.
struct temporal_pictures {
    ao::picture depth;
    ao::picture normal;
    ao::picture motion;
};

// The frames of an animation one after another: what is seen from where, what rays see of it, and the truth.
class temporal_frames {
public:
    // Throws `error`. `input` must outlive it.
    temporal_frames(const render_options& o, scene_input& input);

    // To the next frame, at first to frame 0.
    void advance();

    [[nodiscard]] int frame() const { return frame_; }
    [[nodiscard]] bool cut() const { return moves_.cut_at(frame_); }
    [[nodiscard]] const tools::camera& camera() const { return camera_; }
    [[nodiscard]] const tools::frustum& frustum() const { return frustum_; }
    [[nodiscard]] bool objects_move() const { return moves_.moves_objects(); }
    [[nodiscard]] const ao::temporal_facts& facts() const { return facts_; }
    [[nodiscard]] const ao::gbuffer_facts& targets() const { return targets_; }

    [[nodiscard]] ao::gbuffer_camera drawing() const;
    [[nodiscard]] ao::temporal_camera effect() const;
    // With the transforms of this frame and the one before.
    [[nodiscard]] ao::scene scene() const { return input_.drawn.get(); }

    // Precondition: the options ask for rays or for truth.
    [[nodiscard]] const gbuffer& rays() const { return *rays_; }
    // Precondition: the options ask for rays.
    [[nodiscard]] const temporal_pictures& pictures() const { return pictures_; }
    // Where the options ask for it.
    [[nodiscard]] const std::optional<truth_halves>& truth() const { return truth_; }

private:
    [[nodiscard]] ray_view view_of(const tools::camera& c) const;
    [[nodiscard]] tools::frustum frustum_of(const tools::camera& c) const;
    void trace();
    void make_pictures(const tools::scene& seen);

    const render_options& options_;
    scene_input& input_;
    motion moves_;
    depth_range range_{}; // of all frames, so that the projection stays the same
    float distance_ = 0;
    ao::temporal_facts facts_;
    ao::gbuffer_facts targets_;
    ao::texel_heap heap_; // for the normal maps that rays meet

    int frame_ = -1;
    tools::camera camera_, before_;
    tools::frustum frustum_;
    std::optional<ray_tree> tree_;
    std::optional<gbuffer> rays_;
    temporal_pictures pictures_;
    std::optional<truth_halves> truth_;
};

} // namespace ao::tools
