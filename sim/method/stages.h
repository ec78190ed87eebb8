// Chapter 9, method: where the time of a run goes, by a clock that its caller brings.
#pragma once

#include <array>
#include <functional>
#include <string_view>
#include <utility>

namespace tumble {

/// What a step spends its time on.
enum class StepStage { Rest, Pairs, Points, Forces, Lifting, Audit };

struct StageName {
  std::string_view name, summary;
};
inline constexpr std::array<StageName, 6> kStageNames = {{
    {"rest", "all that is none of these"},
    {"pairs", "which bodies are near each other"},
    {"points", "where they touch"},
    {"forces", "the contact problem"},
    {"lifting", "what overlaps, apart again"},
    {"audit", "the audit"},
}};

/// Seconds of each stage; every instant inside World::advance counts for one of them.
class StageTimes {
 public:
  std::function<double()> clock;                     ///< [s]; empty: nothing is counted
  std::array<double, kStageNames.size()> seconds{};  ///< as kStageNames

  /// From now on time counts for a stage. @return the one before
  StepStage enter(StepStage stage) {
    const double now = clock();
    seconds[static_cast<std::size_t>(stage_)] += now - since_;
    since_ = now;
    return std::exchange(stage_, stage);
  }
  /// Time that went by since the last stage counts for none.
  void skip() { since_ = clock(); }

 private:
  StepStage stage_ = StepStage::Rest;
  double since_ = 0.0;
};

/// Time counts for a stage as long as this lives, but for that of stages within.
class StageScope {
 public:
  StageScope(StageTimes& times, StepStage stage) : times_(times.clock ? &times : nullptr) {
    if (times_) before_ = times_->enter(stage);
  }
  ~StageScope() {
    if (times_) times_->enter(before_);
  }
  StageScope(const StageScope&) = delete;
  StageScope& operator=(const StageScope&) = delete;

 private:
  StageTimes* times_;
  StepStage before_ = StepStage::Rest;
};

}  // namespace tumble
