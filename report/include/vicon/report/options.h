#pragma once

#include <string>
#include <vector>

#include "vicon/core/options.h"

namespace vicon::report {

struct ReportOptions {
    std::string paper = "a4";
    std::string font_folder = "/usr/share/fonts";
    std::vector<std::string> site;
    std::string logo;

    template <class Visitor>
    void visit(Visitor&& v)
    {
        v("report.paper", paper, "", "Size of the report's pages.", {.choices = {"a4", "letter"}});
        v("report.font_folder", font_folder, "", "Where the fonts of the report lie; searched with its subfolders.");
        v("report.site", site, "", "Whose reports these are, at the head of page one: name and address, a line each.");
        v("report.logo", logo, "", "A PNG file that stands beside the site's name.");
    }
};

}  // namespace vicon::report
