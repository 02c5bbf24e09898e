#pragma once

#include "ao/scene.hpp"
#include "camera.hpp"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace ao::tools {

// Where the camera and the objects of a scene are in every frame of an animation; frames count from 0 and may go on for ever.
// A transform moves an object from where the scene has it at rest, in world space.
class motion {
public:
    using camera_path = std::function<camera(int frame)>;
    using object_path = std::function<glm::dmat4(int frame)>; // affine; determinant greater than 0
    struct moving_object {
        std::size_t object = 0; // index into scene::object_names
        object_path at;
    };

    explicit motion(const camera& stands, std::vector<moving_object> objects = {});
    // `cuts`: the frames whose picture has nothing to do with the one before. Empty: none.
    motion(camera_path path, std::vector<moving_object> objects, std::function<bool(int frame)> cuts = {});

    // Precondition for this and what follows: frame >= 0.
    [[nodiscard]] camera camera_at(int frame) const;
    // Of the frame before; the first frame's own for that one.
    [[nodiscard]] camera previous_camera(int frame) const { return camera_at(before(frame)); }
    // Whether the history must be forgotten before this frame. Never the first, which has none.
    [[nodiscard]] bool cut_at(int frame) const;

    // Sets both transforms of every object that moves: this frame's and the one before's, which is this one's in the first frame.
    // Precondition: the objects are a scene_view's, of the scene this was made for.
    void move(std::vector<ao::object>& objects, int frame) const;
    // The scene as it is in this frame, for rays. Object and triangle numbers stay.
    [[nodiscard]] scene moved(const scene& rest, int frame) const;
    // Of an object that stands: the identity.
    [[nodiscard]] glm::dmat4 transform(std::size_t object, int frame) const;

    [[nodiscard]] bool moves(std::size_t object) const;
    [[nodiscard]] bool moves_objects() const { return !objects_.empty(); }
    [[nodiscard]] bool moves_camera() const { return moves_camera_; }

    [[nodiscard]] static int before(int frame) { return frame > 0 ? frame - 1 : 0; }

private:
    camera_path camera_;
    std::vector<moving_object> objects_;
    std::function<bool(int)> cuts_;
    bool moves_camera_ = true;
};

// Of the vertices of one object; nothing where it has no triangles.
[[nodiscard]] std::optional<bounds> bounds_of(const scene& s, std::size_t object);

// What a motion is made for.
struct motion_stage {
    const scene& rest;
    camera start;
    bool courtyard = false; // rest is courtyard(true): its objects move in all presets but `static`
    int frames = 64;        // a cut comes in the middle of them
    int height = 720;       // pixels of a picture: a pan goes half of one in a frame
};

// Each frame half a degree further around a vertical axis through what the start camera looks at, which stays in the middle;
// in the courtyard there and back, clear of the walls.
[[nodiscard]] motion orbit(const motion_stage& s);
// To the left and back, what the start camera looks at by half a pixel a frame.
[[nodiscard]] motion pan(const motion_stage& s);
// Stands, and from the middle of the frames on somewhere else.
[[nodiscard]] motion cut(const motion_stage& s);

// A file of motion (docs/scenes.md). `name` is what errors begin with. Throws `error` with line, column and path.
[[nodiscard]] motion parse_motion(const std::string& name, const std::string& text, const motion_stage& s);

// What --motion names: "static", "orbit", "pan", "cut", or a file. Throws `error`.
[[nodiscard]] motion choose_motion(const std::string& words, const motion_stage& s);

// Whether --motion asks for courtyard(true).
[[nodiscard]] inline bool moves_courtyard(const std::string& words)
{
    return words != "static";
}

} // namespace ao::tools
