// Pinocchio's algorithms in a loop. The model comes as numbers: for each joint its kind (0 floating, 1 2 3 about x y z,
// 4 about an axis), parent, placement, axis, and the mass, centre of mass and inertia about it of its body.
#include <pinocchio/algorithm/aba.hpp>
#include <pinocchio/algorithm/crba.hpp>
#include <pinocchio/algorithm/rnea.hpp>
#include <pinocchio/multibody.hpp>

#include <time.h>

#include <string>

using namespace pinocchio;

namespace {

constexpr int WIDTH = 30;

// The joints that the robots have: with all of Pinocchio's the compiler takes minutes and gigabytes for code never called.
template <typename S, int O>
struct Joints {
    typedef S Scalar;
    static constexpr int Options = O;
    typedef boost::variant<JointModelRevoluteTpl<S, O, 0>, JointModelRevoluteTpl<S, O, 1>, JointModelRevoluteTpl<S, O, 2>,
                           JointModelFreeFlyerTpl<S, O>, JointModelRevoluteUnalignedTpl<S, O>,
                           boost::recursive_wrapper<JointModelMimicTpl<S, O, Joints>>>
        JointModelVariant;
    typedef boost::variant<JointDataRevoluteTpl<S, O, 0>, JointDataRevoluteTpl<S, O, 1>, JointDataRevoluteTpl<S, O, 2>,
                           JointDataFreeFlyerTpl<S, O>, JointDataRevoluteUnalignedTpl<S, O>,
                           boost::recursive_wrapper<JointDataMimicTpl<S, O, Joints>>>
        JointDataVariant;
};

typedef ModelTpl<double, 0, Joints> Tree;
typedef DataTpl<double, 0, Joints> Workspace;

JointIndex add_joint(Tree &model, const double *row, int number)
{
    const Eigen::Matrix3d R = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(row + 2);
    const SE3 placement(R, Eigen::Map<const Eigen::Vector3d>(row + 11));
    const Eigen::Vector3d axis = Eigen::Map<const Eigen::Vector3d>(row + 14);
    const JointIndex parent = static_cast<JointIndex>(row[1]);
    const std::string name = "joint" + std::to_string(number);
    switch (static_cast<int>(row[0])) {
    case 0: return model.addJoint(parent, JointModelFreeFlyer(), placement, name);
    case 1: return model.addJoint(parent, JointModelRX(), placement, name);
    case 2: return model.addJoint(parent, JointModelRY(), placement, name);
    case 3: return model.addJoint(parent, JointModelRZ(), placement, name);
    default: return model.addJoint(parent, JointModelRevoluteUnaligned(axis), placement, name);
    }
}

// Time of the processor, as in loop.c.
double now()
{
    timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return t.tv_sec*1e9 + t.tv_nsec;
}

} // namespace

// kind: 0 inverse dynamics, 1 mass matrix (upper triangle), 2 forward dynamics; returns nanoseconds a call.
extern "C" double pinocchio_loop(int kind, const double *numbers, int joints, const double *q, const double *v,
                                 const double *a, double *out, int states, int repetitions)
{
    Tree model;
    model.gravity.linear(Eigen::Vector3d(0, 0, -9.81));
    for (int k = 0; k < joints; k++) {
        const double *row = numbers + k*WIDTH;
        const JointIndex joint = add_joint(model, row, k);
        const Eigen::Matrix3d inertia = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(row + 21);
        model.appendBodyToJoint(joint, Inertia(row[17], Eigen::Map<const Eigen::Vector3d>(row + 18), inertia));
    }
    Workspace data(model);
    const int nq = model.nq, nv = model.nv;
    const Eigen::Map<const Eigen::MatrixXd> Q(q, nq, states), V(v, nv, states), A(a, nv, states);
    const double start = now();
    for (int r = 0; r < repetitions; r++)
        for (int i = 0; i < states; i++) {
            if (kind == 0) Eigen::Map<Eigen::VectorXd>(out + i*nv, nv) = rnea(model, data, Q.col(i), V.col(i), A.col(i));
            if (kind == 1) Eigen::Map<Eigen::MatrixXd>(out + i*nv*nv, nv, nv) = crba(model, data, Q.col(i));
            if (kind == 2)
                Eigen::Map<Eigen::VectorXd>(out + i*nv, nv) =
                    aba(model, data, Q.col(i), V.col(i), A.col(i), Convention::LOCAL);
        }
    return (now() - start)/(static_cast<double>(repetitions)*states);
}
