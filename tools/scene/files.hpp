#pragma once

#include <filesystem>
#include <string_view>

namespace ao::tools {

// The file holds all of `bytes` afterwards, or is as it was before: written beside it under another name, flushed, and
// renamed. A link is followed; a device or pipe, which cannot be replaced, is written to as it is.
// Throws `error` with path and reason; nothing of the attempt is left behind then.
void write_file(const std::filesystem::path& path, std::string_view bytes);

// Throws `error` where write_file would fail for want of a directory or of permission, and writes nothing.
void check_writable(const std::filesystem::path& path);

// Exists afterwards and takes files. Throws `error`.
void make_directory(const std::filesystem::path& path);

} // namespace ao::tools
