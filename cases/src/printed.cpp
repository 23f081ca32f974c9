#include "vicon/cases/printed.h"

#include <unicode/uchar.h>
#include <unicode/uscript.h>
#include <unicode/utf8.h>

#include <algorithm>
#include <initializer_list>
#include <vector>

namespace vicon {
namespace {

std::vector<std::string> split(std::string_view text, char separator)
{
    std::vector<std::string> parts(1);
    for (const char c : text)
        if (c == separator)
            parts.emplace_back();
        else
            parts.back() += c;
    return parts;
}

std::string trimmed(const std::string& text)
{
    const auto first = text.find_first_not_of(' ');
    return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(' ') - first + 1);
}

std::string joined(const std::vector<std::string>& parts, const char* separator)
{
    std::string out;
    for (const std::string& part : parts)
        if (!part.empty())
            out += (out.empty() ? "" : separator) + part;
    return out;
}

/// Whether a letter of one of these scripts is in the text.
bool hasScript(std::string_view text, std::initializer_list<UScriptCode> scripts)
{
    for (std::int32_t at = 0, size = std::int32_t(text.size()); at < size;) {
        UChar32 c = 0;
        U8_NEXT(text.data(), at, size, c);
        UErrorCode status = U_ZERO_ERROR;
        const UScriptCode script = c < 0 ? USCRIPT_COMMON : uscript_getScript(c, &status);
        if (std::find(scripts.begin(), scripts.end(), script) != scripts.end())
            return true;
    }
    return false;
}

/// One group of a person name: alphabetic, ideographic or phonetic.
std::string nameGroup(const std::string& group)
{
    std::vector<std::string> part = split(group, '^');
    part.resize(5);
    for (std::string& p : part)
        p = trimmed(p);
    const std::string given = joined({part[3], part[1], part[2]}, " ");
    const bool east_asian = hasScript(group, {USCRIPT_HAN, USCRIPT_HIRAGANA, USCRIPT_KATAKANA, USCRIPT_HANGUL});
    const char* comma = east_asian ? " " : hasScript(group, {USCRIPT_ARABIC}) ? "\u060c " : ", ";
    return joined({part[0], given, part[4]}, comma);
}

bool isNumber(std::string_view text)
{
    return !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos;
}

}  // namespace

std::string printedName(std::string_view dicom_name)
{
    std::vector<std::string> groups;
    for (const std::string& group : split(dicom_name, '='))
        if (std::string words = nameGroup(group); !words.empty())
            groups.push_back(std::move(words));
    if (groups.empty())
        return {};
    const std::string first = groups.front();
    groups.erase(groups.begin());
    return groups.empty() ? first : first + " (" + joined(groups, ", ") + ")";
}

std::string printedPatientName(std::string_view dicom_name)
{
    const std::string name = printedName(dicom_name);
    return name.empty() ? "name not given" : name;
}

std::string printedDate(std::string_view dicom_date)
{
    std::string text(dicom_date);
    if (text.size() != 8 || !isNumber(text))
        return text;
    const std::string year = text.substr(0, 4), month = text.substr(4, 2), day = text.substr(6);
    if (month < "01" || month > "12" || day < "01" || day > "31")
        return text;
    return year + "-" + month + "-" + day;
}

}  // namespace vicon
