"""The cell's parts against the models they stand for, and one short trial with each end."""

import numpy as np
import pytest

pytest.importorskip("mujoco", reason="needs the extra palmar[mujoco]")

from palmar.mechanics.arm.puma_560 import LOWER, UPPER, forward
from palmar.mechanics.arm.salisbury_finger import tip_in_hand
from palmar.models.cell_messages import HandMode, HandOrder
from palmar.models.cell_task import FLOATING_TASK, TABLE_TASK, TaskKind
from palmar.models.salisbury_hand import TIP_PREHENSION, SalisburyHand
from palmar.studies.cell_trials import Trials, run_one
from palmar.worlds.cell.faults import Fault, FaultKind
from palmar.worlds.mujoco.cell.cell import Cell
from palmar.worlds.mujoco.cell.judge import OBJECT_FORCE, Judge
from palmar.worlds.mujoco.cell.scene import cell_xml
from palmar.worlds.mujoco.cell.settings import CellSettings
from palmar.worlds.mujoco.cell.trial import run_trial, start_pose
from palmar.worlds.mujoco.engine import mujoco

HAND = SalisburyHand()


def still_cell(**settings) -> Cell:
    return Cell(HAND, TABLE_TASK, CellSettings(**settings), start_pose(HAND, TABLE_TASK))


def test_the_arm_s_and_the_fingers_kinematics_are_those_of_the_model():
    model = mujoco.MjModel.from_xml_string(cell_xml(HAND, TABLE_TASK))
    data, random = mujoco.MjData(model), np.random.default_rng(4)
    flange, hand = model.body("flange").id, model.body("hand").id
    lower, upper = np.array(HAND.joint_limits).T
    for _ in range(200):
        joints, fingers = random.uniform(LOWER, UPPER), random.uniform(lower, upper, (3, 3))
        data.qpos[:6], data.qpos[6:15] = joints, fingers.ravel()
        mujoco.mj_kinematics(model, data)
        pose = forward(joints)
        assert np.abs(data.xpos[flange] - pose[:3, 3]).max() < 1e-9
        assert np.abs(data.xmat[flange].reshape(3, 3) - pose[:3, :3]).max() < 1e-9
        for k in range(3):
            tip = data.xmat[hand].reshape(3, 3).T @ (data.site(f"tip_{k}").xpos - data.xpos[hand])
            assert np.abs(tip - tip_in_hand(HAND, k, fingers[k])).max() < 1e-9


@pytest.mark.parametrize("task", [TABLE_TASK, FLOATING_TASK], ids=lambda task: task.kind.value)
def test_nothing_is_attached_to_anything(task):
    """Only the thread ties the floating cylinder, to its bar; no equality constraint anywhere."""
    model = mujoco.MjModel.from_xml_string(cell_xml(HAND, task))
    assert model.neq == 0
    assert model.ntendon == (task.kind is TaskKind.FLOATING)
    assert model.body("object").parentid[0] == 0
    assert model.opt.gravity[2] == pytest.approx(-9.81)


def test_a_push_on_a_tip_is_felt_as_its_torque_through_the_tendons_alone():
    cell = still_cell(tension_noise=0.0)
    force = np.array([0.0, 0.0, 6.0])
    proximal, distal = cell.model.body("proximal_1").id, cell.model.body("distal_1").id
    for _ in range(400):
        tip = cell.data.site("tip_1").xpos.copy()
        cell.data.qfrc_applied[:] = 0.0
        mujoco.mj_applyFT(cell.model, cell.data, force, np.zeros(3), tip, distal, cell.data.qfrc_applied)
        cell.data.qfrc_applied[:6] = 0.0
        cell.tick()
    expected = cell.data.qfrc_applied[6:15].reshape(3, 3)
    assert proximal != distal
    assert cell.sense.torque[1] == pytest.approx(expected[1], abs=3e-3)
    assert np.abs(cell.sense.torque[[0, 2]]).max() < 3e-3
    assert cell.seen().touched == (False, True, False)


def test_tendons_only_pull_and_only_so_hard():
    cell = still_cell()
    cell.order = HandOrder(HandMode.SHAPE, (1.3, 1.3, 1.3), TIP_PREHENSION, rate=1000.0)
    pulled = []
    for _ in range(50):
        cell.tick()
        pulled.append(cell.readings)
    assert np.min(pulled) > HAND.tension_least - 5.0 * cell.settings.tension_noise
    assert HAND.tension_most - 1.0 < np.max(pulled) < HAND.tension_most + 5.0 * cell.settings.tension_noise


def test_a_cylinder_is_picked_up_from_the_table():
    result = run_trial(HAND, TABLE_TASK, CellSettings(seed=1))
    assert (result.outcome, result.end, result.unsafe, result.approaches) == ("success", "holds", (), 1)
    assert [owner for _, owner in result.trace][-3:] == ["palm", "behaviour", "grip"]
    assert (result.missed, result.table_force) == (0, 0.0)


def test_a_floating_cylinder_is_caught_softly_and_no_finger_goes_through_another():
    """Fingers slow down before they meet it: a third of what it takes to be unsafe."""
    nearest, tips = [], [f"tip_{k}" for k in range(3)]

    def watch(cell):
        places = [cell.data.site(each).xpos for each in tips]
        nearest.append(min(np.linalg.norm(places[k] - places[k - 1]) for k in range(3)))

    result = run_trial(HAND, FLOATING_TASK, CellSettings(seed=1), watch=watch)
    assert (result.outcome, result.unsafe) == ("success", ())
    assert 20.0 < result.object_force < 80.0
    assert min(nearest) > 2.0 * HAND.tip_radius


def test_a_blow_of_one_tick_is_noticed_with_the_engine_s_own_force():
    cell = still_cell()
    judge, force = Judge(cell), np.zeros(6)
    tip, place = cell.data.site("tip_0").xpos, cell.model.joint("object").qposadr[0]
    for depth in (0.0, 0.030):
        cell.data.qpos[place : place + 3] = tip + np.array(
            [HAND.tip_radius + TABLE_TASK.cylinder.radius - depth, 0.0, 0.0]
        )
        mujoco.mj_step1(cell.model, cell.data)
        mujoco.mj_step2(cell.model, cell.data)
        judge.feel()
    blow = 0.0
    for i in range(cell.data.ncon):
        mujoco.mj_contactForce(cell.model, cell.data, i, force)
        blow += force[0]
    cell.data.qpos[place : place + 3] = (0.4, 0.4, 0.5)
    cell.tick()
    judge.feel()
    judge.weigh()
    assert cell.data.ncon == 0
    assert judge.object_force == pytest.approx(blow)
    assert judge.table_force == 0.0
    assert blow > OBJECT_FORCE
    assert judge.faults == {f"pressed the object with more than {OBJECT_FORCE:g} N"}


def test_a_cylinder_that_is_not_known_well_enough_is_felt_for_first():
    result = run_one((Trials(TaskKind.TABLE, 1, seed=1, error=0.03, exact=True), 0))
    assert (result.outcome, result.unsafe) == ("success", ())
    order = [what for _, what in result.phases]
    assert order.index("lower narrow fingers to feel") < order.index("lower the open hand") < order.index("close")


def test_one_that_would_topple_is_left_alone():
    from dataclasses import replace

    tall = replace(TABLE_TASK, cylinder=replace(TABLE_TASK.cylinder, height=0.28))
    result = run_trial(HAND, tall, CellSettings(seed=1))
    assert (result.outcome, result.object_force, result.unsafe) == ("would topple", 0.0, ())


def test_without_friction_nothing_is_held():
    """What holds the cylinder is friction, so without it the trial must fail."""
    from dataclasses import replace

    slippery = replace(TABLE_TASK, cylinder=replace(TABLE_TASK.cylinder, friction_hand=0.0))
    assert run_trial(HAND, slippery, CellSettings(seed=1)).outcome == "slipped"


def test_a_palm_that_comes_askew_is_turned_square_before_it_closes():
    result = run_one((Trials(TaskKind.ALIGN, 1, seed=3, turn=np.radians(10.0)), 0))
    assert (result.outcome, result.unsafe) == ("success", ())
    phases = {what: time for time, what in result.phases}
    assert phases["close"] - phases["turn about the contact"] > 1.0


def test_a_late_reply_stops_the_arm_safely_and_is_counted():
    result = run_trial(HAND, TABLE_TASK, CellSettings(fault=Fault(FaultKind.LATE_REPLY, 0.9)))
    assert (result.outcome, result.unsafe) == ("stopped", ())
    assert result.missed >= 1
    assert result.trace[-1][1] == "safe stop"
    assert result.seconds < 2.0


def test_at_every_end_but_the_good_one_the_hand_is_stopped():
    result = run_trial(HAND, TABLE_TASK, CellSettings(fault=Fault(FaultKind.CAMERA_KILLED, 0.9)))
    assert (result.outcome, result.unsafe, result.trace[-1][1]) == ("no fresh sighting", (), "safe stop")


def test_trials_depend_on_seed_and_number_only():
    trials = Trials(TaskKind.TABLE, 60, seed=8, fault=FaultKind.LATE_REPLY)
    k = min(range(60), key=lambda each: trials.settings(each).fault.start)
    assert trials.settings(k) == trials.settings(k) != trials.settings(k + 1)
    one, again = run_one((trials, k)), run_one((trials, k))
    assert (one.outcome, one.seconds, one.trace) == (again.outcome, again.seconds, again.trace)
