#pragma once

#include <string>

namespace vicon {

/// Whether a scan shows the organ that was sought in it.
enum class Verdict { found, unsure, absent };

/// As scan.json has it and people read it, of an organ's title: "colon", "unsure" or "no colon".
std::string verdictText(Verdict verdict, const std::string& organ_title);
/// What verdictText() made of any title.
Verdict verdictFrom(const std::string& text);
/// The organ's title in what verdictText() made; empty of "unsure".
std::string titleIn(const std::string& verdict_text);

}  // namespace vicon
