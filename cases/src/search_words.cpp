#include "search_words.h"

#include <unicode/unistr.h>

#include <algorithm>

namespace vicon {
namespace {

/// Of a text. Names of many parts have ten; each word is a row for every case, and a look into the list when searched.
constexpr std::size_t kMostWords = 100;

std::string lowerCase(const std::string& text)
{
    std::string out;
    icu::UnicodeString::fromUTF8(text).foldCase().toUTF8String(out);
    return out;
}

}  // namespace

std::vector<std::string> wordsIn(const std::string& text)
{
    constexpr const char* kBetween = " \t\n^=,";
    const std::string lower = lowerCase(text);
    std::vector<std::string> words;
    for (std::size_t from = lower.find_first_not_of(kBetween);
         from != std::string::npos && words.size() < kMostWords;) {
        const std::size_t to = std::min(lower.find_first_of(kBetween, from), lower.size());
        words.push_back(lower.substr(from, to - from));
        from = lower.find_first_not_of(kBetween, to);
    }
    return words;
}

std::vector<std::string> searchWords(const CaseRecord& a_case)
{
    std::vector<std::string> words;
    for (const std::string& text :
         {a_case.patient.name, a_case.patient.id, a_case.study.accession_number, a_case.study.date, a_case.id})
        std::ranges::copy(wordsIn(text), std::back_inserter(words));
    std::ranges::sort(words);
    words.erase(std::unique(words.begin(), words.end()), words.end());
    return words;
}

std::string rarestOf(const std::vector<std::string>& words, int most,
                     const std::function<int(const std::string& beginning, int limit)>& count)
{
    constexpr int kFirstLimit = 50, kGrowth = 4;
    for (int limit = std::min(kFirstLimit, most);; limit = std::min(kGrowth * limit, most)) {
        std::vector<int> counts;
        for (const std::string& word : words)
            counts.push_back(words.size() == 1 ? 0 : count(word, limit));
        const auto least = std::ranges::min_element(counts);
        if (*least < limit || limit == most)
            return words[std::size_t(least - counts.begin())];
    }
}

void putSearchWords(soci::session& sql, const CaseRecord& a_case)
{
    for (const std::string& word : searchWords(a_case))
        sql << "INSERT INTO case_words (word, case_id) VALUES (:w, :c) ON CONFLICT (word, case_id) DO NOTHING",
            soci::use(word), soci::use(a_case.id);
}

std::string endOf(const std::string& beginning)
{
    constexpr const char* kLastCharacter = "\xF4\x8F\xBF\xBF";  // U+10FFFF, the last in UTF-8's order of bytes
    return beginning + kLastCharacter;
}

}  // namespace vicon
