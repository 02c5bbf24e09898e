#pragma once

#include "images.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace ao::tools {

// A gray picture that moves: PNG with the chunks acTL, fcTL and fdAT (PNG 3rd edition, APNG), shown over and over. Programs that
// know nothing of animations show its first frame. Frames are held compressed.
class animation {
public:
    // Precondition: frames_per_second is 1 to 65535.
    animation(extent size, int frames_per_second) : size_(size), rate_(frames_per_second) {}

    // Row 0 on top, as many as the size asks for. Throws `error`.
    void add(std::span<const std::uint8_t> gray);
    [[nodiscard]] std::size_t frames() const { return frames_.size(); }

    // The file's bytes. Precondition: there is a frame.
    [[nodiscard]] std::string encode() const;

private:
    extent size_;
    int rate_;
    std::vector<std::string> frames_; // zlib streams of filtered rows
};

} // namespace ao::tools
