// Pinocchio: forward kinematics of one frame; inverse by damped Gauss–Newton steps on its frame Jacobian, as its manual shows.
#include "chain.hpp"
#include <pinocchio/algorithm/frames.hpp>
#include <pinocchio/algorithm/joint-configuration.hpp>
#include <pinocchio/algorithm/kinematics.hpp>
#include <pinocchio/multibody.hpp>
#include <pinocchio/spatial.hpp>
#include <vector>

int main(int argc, char **argv) {
  namespace pin = pinocchio;
  using Eigen::Vector3d;
  const auto at = [](double x) { return pin::SE3(Eigen::Matrix3d::Identity(), Vector3d(x, 0, 0)); };
  pin::Model model;
  const pin::JointModelRevoluteUnaligned plane(0, -1, 0);
  const auto swing = model.addJoint(0, pin::JointModelRZ(), pin::SE3::Identity(), "swing");
  const auto boom = model.addJoint(swing, plane, at(A1), "boom");
  const auto arm = model.addJoint(boom, plane, at(A2), "arm");
  const auto bucket = model.addJoint(arm, plane, at(A3), "bucket");
  const auto tip = model.addFrame(pin::Frame("tip", bucket, 0, at(A4), pin::OP_FRAME));
  pin::Data data(model);
  const auto forward = [&](const Eigen::VectorXd &q) {
    pin::forwardKinematics(model, data, q);
    return pin::updateFramePlacement(model, data, tip);
  };
  std::vector<Eigen::VectorXd> q(POSES, Eigen::VectorXd(4));
  std::vector<pin::SE3> tips(POSES);
  for (int i = 0; i < POSES; i++) {
    for (int j = 0; j < 4; j++) q[i](j) = joints(i)[j];
    tips[i] = forward(q[i]);
    const auto want = expected(joints(i));
    check("Pinocchio's tip", (tips[i].translation() - Vector3d(want[0], want[1], want[2])).norm(), 1e-9);
  }
  const auto inverse = [&](int i) {
    Eigen::VectorXd at(4);
    at << SWING, 0, -1.2, -1.0;
    pin::Data::Matrix6x J(6, 4);
    for (int step = 0; step < 100; step++) {
      const auto error = pin::log6(forward(at).actInv(tips[i])).toVector();
      if (error.norm() < 1e-5) break;
      J.setZero();
      pin::computeFrameJacobian(model, data, at, tip, J);
      Eigen::Matrix4d JtJ = J.transpose() * J;
      JtJ.diagonal().array() += 1e-9;
      at += JtJ.ldlt().solve(J.transpose() * error);
    }
    return at(1);
  };
  return run(argc, argv, [&](int i) { return forward(q[i]).translation().x(); }, inverse);
}
