// A diagnosis as a page for people: one self-contained HTML document.
#pragma once

#include <string>

#include "reco/diagnose/diagnosis.h"

namespace floe {

struct ReportFacts {
  std::string data, ice, command, version;
  std::string base_hash, improved_hash;
  std::string look_again;  // the command that diagnoses the improved model
  double flow_deg = 0;
  std::uint64_t seed = 1;
};

// Which runs the gaps are of, in words.
const char* judged_runs(const Diagnosis& diagnosis);
// One sentence: what is missing, or that nothing is.
std::string verdict_sentence(const Diagnosis& diagnosis, double alpha);
std::string report_html(const Diagnosis& diagnosis, const DiagnosisOptions& options,
                        const ReportFacts& facts);

}  // namespace floe
