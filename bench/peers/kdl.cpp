// Orocos KDL: recursive forward kinematics; inverse by its Levenberg–Marquardt solver from a pose in mid-stroke.
#include "chain.hpp"
#include <kdl/chain.hpp>
#include <kdl/chainfksolverpos_recursive.hpp>
#include <kdl/chainiksolverpos_lma.hpp>
#include <vector>

int main(int argc, char **argv) {
  using namespace KDL;
  const auto plane = [] { return Joint(Vector::Zero(), Vector(0, -1, 0), Joint::RotAxis); };
  Chain chain;
  chain.addSegment(Segment(Joint(Joint::RotZ), Frame(Vector(A1, 0, 0))));
  chain.addSegment(Segment(plane(), Frame(Vector(A2, 0, 0))));
  chain.addSegment(Segment(plane(), Frame(Vector(A3, 0, 0))));
  chain.addSegment(Segment(plane(), Frame(Vector(A4, 0, 0))));
  ChainFkSolverPos_recursive fk(chain);
  ChainIkSolverPos_LMA ik(chain, 1e-5);
  std::vector<JntArray> q(POSES, JntArray(4));
  std::vector<Frame> tips(POSES);
  for (int i = 0; i < POSES; i++) {
    for (int j = 0; j < 4; j++) q[i](j) = joints(i)[j];
    fk.JntToCart(q[i], tips[i]);
    const auto want = expected(joints(i));
    check("KDL's tip", (tips[i].p - Vector(want[0], want[1], want[2])).Norm(), 1e-9);
  }
  JntArray start(4), found(4);
  start(0) = SWING, start(1) = 0, start(2) = -1.2, start(3) = -1.0;
  Frame tip;
  return run(
      argc, argv,
      [&](int i) { fk.JntToCart(q[i], tip); return tip.p.x(); },
      [&](int i) { ik.CartToJnt(start, tips[i], found); return found(1); });
}
