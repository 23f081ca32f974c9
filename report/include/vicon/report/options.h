#pragma once

#include <string>

#include "vicon/core/options.h"

namespace vicon::report {

struct ReportOptions {
    std::string paper = "a4";
    std::string font_folder = "/usr/share/fonts";

    template <class Visitor>
    void visit(Visitor&& v)
    {
        v("report.paper", paper, "", "Size of the report's pages.", {.choices = {"a4", "letter"}});
        v("report.font_folder", font_folder, "", "Where the fonts of the report lie; searched with its subfolders.");
    }
};

}  // namespace vicon::report
