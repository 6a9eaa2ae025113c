#pragma once

#include "oriel/stage.h"
#include "studio/session/request_body.h"

#include <cstddef>
#include <mutex>
#include <string>
#include <utility>

namespace oriel::studio {

/// How far the drawing for a scale is that was begun last. Functions may be called from any thread.
class DrawingProgress {
 public:
  /// A drawing at work, from its beginning to its end.
  class DrawingAtWork {
   public:
    DrawingAtWork(DrawingProgress& progress, std::size_t building, std::string target)
        : progress_(progress) {
      const std::lock_guard lock(progress_.mutex_);
      number_ = ++progress_.begun_;
      progress_.building_ = building;
      progress_.target_ = std::move(target);
      progress_.stage_ = Stage::interpret;
      progress_.step_ = 0;
      progress_.is_at_work_ = true;
    }
    ~DrawingAtWork() {
      const std::lock_guard lock(progress_.mutex_);
      if (progress_.begun_ == number_) progress_.is_at_work_ = false;
    }
    DrawingAtWork(const DrawingAtWork&) = delete;
    DrawingAtWork& operator=(const DrawingAtWork&) = delete;

    void pass(Stage stage) {
      const std::lock_guard lock(progress_.mutex_);
      if (progress_.begun_ != number_) return;
      progress_.stage_ = stage;
      ++progress_.step_;
    }

   private:
    DrawingProgress& progress_;
    std::size_t number_ = 0;
  };

  /// {state: "idle"}, or {state: "running", building, target, stage, step}.
  [[nodiscard]] StudioJson json() const {
    const std::lock_guard lock(mutex_);
    if (!is_at_work_) return {{"state", "idle"}};
    return {{"state", "running"},
            {"building", building_},
            {"target", target_},
            {"stage", name_of(stage_)},
            {"step", step_}};
  }

 private:
  static const char* name_of(Stage stage) {
    switch (stage) {
      case Stage::interpret:
        return "labelling";
      case Stage::solidify:
        return "repairing";
      case Stage::write:
        return "checking";
      default:
        return "drawing";
    }
  }

  mutable std::mutex mutex_;
  bool is_at_work_ = false;
  std::size_t begun_ = 0, building_ = 0, step_ = 0;
  std::string target_;
  Stage stage_ = Stage::interpret;
};

}  // namespace oriel::studio
