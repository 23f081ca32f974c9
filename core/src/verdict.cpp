#include "vicon/core/verdict.h"

#include <string_view>

namespace vicon {
namespace {

constexpr std::string_view kUnsure = "unsure", kNo = "no ";

}  // namespace

std::string verdictText(Verdict verdict, const std::string& organ_title)
{
    switch (verdict) {
        case Verdict::found:
            return organ_title;
        case Verdict::unsure:
            return std::string(kUnsure);
        case Verdict::absent:
            return std::string(kNo) + organ_title;
    }
    return std::string(kUnsure);
}

Verdict verdictFrom(const std::string& text)
{
    return text == kUnsure ? Verdict::unsure : text.starts_with(kNo) ? Verdict::absent : Verdict::found;
}

std::string titleIn(const std::string& verdict_text)
{
    switch (verdictFrom(verdict_text)) {
        case Verdict::found:
            return verdict_text;
        case Verdict::unsure:
            return {};
        case Verdict::absent:
            return verdict_text.substr(kNo.size());
    }
    return {};
}

}  // namespace vicon
