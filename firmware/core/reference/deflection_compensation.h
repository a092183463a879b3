// Static deflection compensation (22): the offset in θ_d that puts the bent arm's tool point on the plan. The paper
// calls it nodal displacement. RT: safe.
#pragma once

#include "reed/core/model/static_deflection.h"
#include "reed/core/reference/smooth_offset.h"

namespace reed::strategy {

template <int N, int P>
class DeflectionCompensation {
 public:
  DeflectionCompensation(const model::ArmModel<N, P>& arm, const Eigen::Vector3d& normal, bool compensate,
                         double T) noexcept
      : arm_(arm), normal_(normal), compensate_(compensate), smooth_(T) {}

  void Reset() noexcept { smooth_.Reset(); }

  /// planned: the poses at the plan. p_hat: parameters as estimated. f_d: N. update: false keeps the offset of the
  /// last cycle. In contact p̂ also explains what the wall does, so the weight is that of the last free estimate.
  control::Reference<N> Step(const control::Reference<N>& plan, const model::LinkPoses<N>& planned,
                             const model::Vec<P>& p_hat, double f_d, bool in_contact, bool update) noexcept {
    if (compensate_ && update) {
      if (!in_contact) p_free_ = p_hat;
      const model::Bodies<N> bodies = model::BodiesFor<N, P>(arm_, p_free_);
      model::Wrench press;
      press.F = f_d * normal_;
      offset_ = model::CompensateDeflection<N, P>(arm_, planned, bodies, press).offset;
    }
    return smooth_.Step(plan, offset_);
  }

 private:
  const model::ArmModel<N, P>& arm_;
  Eigen::Vector3d normal_;
  bool compensate_;
  SmoothOffset<N> smooth_;
  model::Vec<N> offset_ = model::Vec<N>::Zero();
  model::Vec<P> p_free_ = model::Vec<P>::Zero();  // p̂ when last free
};

}  // namespace reed::strategy
