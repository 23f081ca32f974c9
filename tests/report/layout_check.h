#pragma once

#include <filesystem>
#include <string>

namespace vicon::report::samples {

/// Holds a PDF against what is kept of it in tests/report/layout: where each word stands, to a point, and the pages'
/// ink at 24 dots an inch. With VICON_KEEP_LAYOUT in the environment it is kept anew: look at the pages before.
void expectLayout(const std::filesystem::path& pdf, const std::string& name);

}  // namespace vicon::report::samples
