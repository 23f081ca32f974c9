#pragma once

#include <string>
#include <vector>

#include "vicon/core/option_names.h"
#include "vicon/core/options.h"

namespace vicon::report {

enum class Paper { a4, letter };
inline constexpr EnumNames<Paper, 2> kPaperNames{{{Paper::a4, "a4"}, {Paper::letter, "letter"}}};
constexpr const auto& optionNames(Paper /*value*/)
{
    return kPaperNames;
}

struct ReportOptions {
    Paper paper = Paper::a4;
    std::string font_folder = "/usr/share/fonts";
    std::vector<std::string> site;
    std::string logo;

    template <class Visitor>
    void visit(Visitor&& v)
    {
        v("report.paper", paper, "", "Size of the report's pages.", choicesOf(paper));
        v("report.font_folder", font_folder, "", "Where the fonts of the report lie; searched with its subfolders.");
        v("report.site", site, "", "Whose reports these are, at the head of page one: name and address, a line each.");
        v("report.logo", logo, "", "A PNG file that stands beside the site's name.");
    }
};

}  // namespace vicon::report
