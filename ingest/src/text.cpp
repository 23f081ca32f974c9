#include "text.h"

#include <unicode/ucnv.h>
#include <unicode/unistr.h>

#include <array>
#include <memory>

namespace vicon::ingest {
namespace {

constexpr char kEscape = 0x1b;

/// How bytes of one half of the code table are read.
struct CodeElement {
    const char* defined_term;  ///< of Specific Character Set, the part after "ISO 2022 " or "ISO_"
    const char* escape;        ///< what follows ESC
    bool upper;                ///< designated as G1: bytes above 127
    int bytes_per_character;
    const char* converter;  ///< ICU's name
};

constexpr std::array kCodeElements{
    CodeElement{"IR 6", "(B", false, 1, "US-ASCII"},     CodeElement{"IR 100", "-A", true, 1, "ISO-8859-1"},
    CodeElement{"IR 101", "-B", true, 1, "ISO-8859-2"},  CodeElement{"IR 109", "-C", true, 1, "ISO-8859-3"},
    CodeElement{"IR 110", "-D", true, 1, "ISO-8859-4"},  CodeElement{"IR 144", "-L", true, 1, "ISO-8859-5"},
    CodeElement{"IR 127", "-G", true, 1, "ISO-8859-6"},  CodeElement{"IR 126", "-F", true, 1, "ISO-8859-7"},
    CodeElement{"IR 138", "-H", true, 1, "ISO-8859-8"},  CodeElement{"IR 148", "-M", true, 1, "ISO-8859-9"},
    CodeElement{"IR 203", "-b", true, 1, "ISO-8859-15"}, CodeElement{"IR 166", "-T", true, 1, "TIS-620"},
    CodeElement{"IR 13", ")I", true, 1, "Shift_JIS"},   // katakana
    CodeElement{"IR 14", "(J", false, 1, "JIS-roman"},  // comes with IR 13; no converter of ICU, see convertRun()
    CodeElement{"IR 87", "$B", false, 2, "EUC-JP"},      CodeElement{"IR 159", "$(D", false, 2, "EUC-JP"},
    CodeElement{"IR 149", "$)C", true, 2, "EUC-KR"},     CodeElement{"IR 58", "$)A", true, 2, "GB2312"},
};

const CodeElement* elementFor(std::string_view term)
{
    for (const std::string_view prefix : {"ISO 2022 ", "ISO_", "ISO-"})
        if (term.starts_with(prefix))
            term.remove_prefix(prefix.size());
    for (const CodeElement& element : kCodeElements)
        if (term == element.defined_term)
            return &element;
    return nullptr;
}

const CodeElement* elementByEscape(std::string_view after_escape)
{
    for (const CodeElement& element : kCodeElements)
        if (after_escape.starts_with(element.escape))
            return &element;
    return nullptr;
}

std::string utf8From(const icu::UnicodeString& text)
{
    std::string out;
    text.toUTF8String(out);
    return out;
}

std::string convert(std::string_view bytes, const char* converter)
{
    UErrorCode status = U_ZERO_ERROR;
    const std::unique_ptr<UConverter, decltype(&ucnv_close)> opened(ucnv_open(converter, &status), ucnv_close);
    if (U_FAILURE(status))
        return std::string(bytes.size(), '?');
    icu::UnicodeString text(bytes.data(), int32_t(bytes.size()), opened.get(), status);
    return utf8From(text);
}

bool isUtf8(std::string_view bytes)
{
    return utf8From(icu::UnicodeString::fromUTF8(icu::StringPiece(bytes.data(), int32_t(bytes.size())))) == bytes;
}

/// Converts bytes that all belong to one code element.
std::string convertRun(std::string_view bytes, const CodeElement& element)
{
    const std::string_view term = element.defined_term;
    if (term == "IR 14") {  // ASCII but for two signs
        std::string out;
        for (const char byte : bytes)
            out += byte == '\\' ? "\u00a5" : byte == '~' ? "\u203e" : std::string(1, byte);
        return out;
    }
    if (term != "IR 87" && term != "IR 159")
        return convert(bytes, element.converter);
    std::string euc;  // the same tables, with the high bit set
    for (std::size_t n = 0; n + 1 < bytes.size(); n += 2) {
        if (term == "IR 159")
            euc += '\x8f';
        euc += char(bytes[n] | 0x80);
        euc += char(bytes[n + 1] | 0x80);
    }
    return convert(euc, element.converter);
}

/// Reads a text with code extensions: two halves of the code table, redesignated by escape sequences.
class CodeExtensionReader {
public:
    CodeExtensionReader(const std::vector<std::string>& character_sets, TextKind kind) : kind_(kind)
    {
        const CodeElement* first = character_sets.empty() ? nullptr : elementFor(character_sets.front());
        if (first && first->upper) {
            initial_upper_ = first;
            if (std::string_view(first->defined_term) == "IR 13")
                initial_lower_ = elementFor("IR 14");
        }
        // Writers that leave out the escape before a two-byte set of G1 mean the one that they declared.
        for (const std::string& set : character_sets)
            if (const CodeElement* element = elementFor(set); element && element->upper && !initial_upper_)
                initial_upper_ = element;
        reset();
    }

    std::string read(std::string_view bytes)
    {
        for (std::size_t n = 0; n < bytes.size();)
            n += bytes[n] == kEscape ? designate(bytes.substr(n)) : take(bytes.substr(n));
        flush();
        return out_;
    }

private:
    void reset()
    {
        lower_ = initial_lower_;
        upper_ = initial_upper_;
    }

    std::size_t designate(std::string_view rest)
    {
        flush();
        const CodeElement* element = elementByEscape(rest.substr(1));
        if (!element) {
            out_ += kEscape;  // shown by printable()
            return 1;
        }
        (element->upper ? upper_ : lower_) = element;
        return 1 + std::string_view(element->escape).size();
    }

    bool isDelimiter(char byte) const
    {
        if (byte == '\r' || byte == '\n' || byte == '\f' || byte == '\t')
            return true;
        return lower_->bytes_per_character == 1 && kind_ == TextKind::person_name && (byte == '^' || byte == '=');
    }

    std::size_t take(std::string_view rest)
    {
        const char byte = rest.front();
        if (isDelimiter(byte)) {
            flush();
            reset();
            out_ += byte;
            return 1;
        }
        const CodeElement* element = (byte & 0x80) ? upper_ : lower_;
        if (!element) {
            flush();
            out_ += "\ufffd";
            return 1;
        }
        if (element != run_element_)
            flush();
        run_element_ = element;
        const std::size_t count = std::min<std::size_t>(element->bytes_per_character, rest.size());
        run_ += rest.substr(0, count);
        return count;
    }

    void flush()
    {
        if (!run_.empty())
            out_ += convertRun(run_, *run_element_);
        run_.clear();
        run_element_ = nullptr;
    }

    TextKind kind_;
    const CodeElement* initial_lower_ = elementFor("IR 6");
    const CodeElement* initial_upper_ = nullptr;
    const CodeElement* lower_ = nullptr;
    const CodeElement* upper_ = nullptr;
    const CodeElement* run_element_ = nullptr;
    std::string run_;
    std::string out_;
};

std::string_view withoutPadding(std::string_view bytes)
{
    while (!bytes.empty() && (bytes.back() == ' ' || bytes.back() == '\0'))
        bytes.remove_suffix(1);
    return bytes;
}

bool isAscii(std::string_view bytes)
{
    for (const char byte : bytes)
        if (byte & 0x80 || byte == kEscape)
            return false;
    return true;
}

}  // namespace

std::string toUtf8(std::string_view bytes, const std::vector<std::string>& character_sets, TextKind kind)
{
    bytes = withoutPadding(bytes);
    const std::string first = character_sets.empty() ? "" : character_sets.front();
    if (isAscii(bytes) && !first.ends_with("IR 13"))  // whose lower half is not ASCII
        return std::string(bytes);
    if (first == "ISO_IR 192")
        return isUtf8(bytes) ? std::string(bytes) : convert(bytes, "UTF-8");
    if (first == "GB18030" || first == "GBK")
        return convert(bytes, "gb18030");
    const bool declared = character_sets.size() > 1 || !first.empty();
    if (!declared && bytes.find(kEscape) == std::string_view::npos)
        return isUtf8(bytes) ? std::string(bytes) : convert(bytes, "ISO-8859-1");
    return CodeExtensionReader(character_sets, kind).read(bytes);
}

std::string tidyPersonName(const std::string& name)
{
    std::string tidy;
    std::size_t from = 0;
    while (from <= name.size()) {
        const std::size_t to = std::min(name.find('=', from), name.size());
        std::string group = name.substr(from, to - from);
        while (!group.empty() && (group.back() == '^' || group.back() == ' '))
            group.pop_back();
        tidy += (from ? "=" : "") + group;
        from = to + 1;
    }
    while (!tidy.empty() && tidy.back() == '=')
        tidy.pop_back();
    return tidy;
}

std::string foldedForComparison(const std::string& text)
{
    icu::UnicodeString folded = icu::UnicodeString::fromUTF8(tidyPersonName(text));
    folded.foldCase();
    icu::UnicodeString out;
    bool gap = false;
    for (int32_t n = 0; n < folded.length(); ++n) {
        const char16_t unit = folded[n];
        if (unit == u' ' || unit == u'^') {
            gap = true;
            continue;
        }
        if (gap && !out.isEmpty())
            out.append(u' ');
        gap = false;
        out.append(unit);
    }
    return utf8From(out);
}

}  // namespace vicon::ingest
