"""What a module promises, on modules of models/ that lie on the path: run by python_test.cpp."""
import ast
import copy
import importlib
import inspect
import os
import pickle
import shutil
import subprocess
import sys
import tempfile
import threading
import unittest

import numpy as np

import cart_pole
import crane
import panda
import quadrotor
import squeezer

EXPLICIT = ("euler", "semi_implicit_euler", "heun", "rk4", "rk5", "adams_bashforth2", "adams_bashforth3")


class Names(unittest.TestCase):
    def test_variables_have_units_starts_and_shapes(self):
        mass = cart_pole.VARIABLES["pole_mass"]
        self.assertEqual((mass.unit, mass.role, mass.quantity, float(mass.start), mass.shape),
                         ("kg", "parameter", "mass", 0.1, ()))
        self.assertEqual(cart_pole.VARIABLES["hinge"].unit, "rad")
        self.assertEqual(quadrotor.VARIABLES["pose.rotation"].shape, (3, 3))
        self.assertEqual(quadrotor.INPUTS, ("thrust1", "thrust2", "thrust3", "thrust4"))
        self.assertEqual(len(quadrotor.POSITIONS), 7)
        with self.assertRaises(ValueError):
            mass.start[...] = 1

    def test_a_name_that_does_not_exist_is_answered_with_one_that_does(self):
        model = cart_pole.Model()
        with self.assertRaisesRegex(AttributeError, "no parameter 'pole_mas'; did you mean 'pole_mass'"):
            model.parameters.pole_mas = 2
        with self.assertRaisesRegex(AttributeError, "did you mean 'cart_mass'"):
            cart_pole.Model(cart_mas=2)
        with self.assertRaisesRegex(KeyError, "no input 'pusch'; did you mean 'push'"):
            model.forward_dynamics(model.initial_state(), {"pusch": 1})
        with self.assertRaisesRegex(KeyError, "no position or velocity 'hing'"):
            model.initial_state()["hing"]
        with self.assertRaisesRegex(ValueError, "no method 'rk45'; did you mean 'rk5'"):
            model.simulate(model.initial_state(), 1, 0.1, method="rk45")
        with self.assertRaisesRegex(KeyError, "no output 'x'"):
            model.simulate(model.initial_state(), 1, 0.1, outputs="x")

    def test_methods_have_signatures_and_descriptions_and_the_stub_has_the_same(self):
        for module in (cart_pole, crane, panda, quadrotor, squeezer):
            with open(os.path.splitext(module.__file__)[0] + ".pyi") as text:
                stub = ast.parse(text.read())
            declared = {node.name: node for node in stub.body if isinstance(node, ast.ClassDef)}
            methods = {node.name: [argument.arg for argument in node.args.args]
                       for node in declared["Model"].body if isinstance(node, ast.FunctionDef)}
            for name, method in vars(module.Model).items():
                if name.startswith("_") or not callable(method):
                    continue
                self.assertEqual(methods.pop(name), list(inspect.signature(method).parameters), name)
                self.assertTrue(method.__doc__, name)
            self.assertEqual(set(methods), {"__init__", "parameters"})
            for name in module.__all__:
                self.assertTrue(name in declared or f"\n{name}: " in ast.unparse(stub), name)

    def test_parameters_of_any_name_are_items(self):
        parameters = cart_pole.Model().parameters
        self.assertEqual(list(parameters), list(cart_pole.PARAMETERS))
        parameters["cart_mass"] = 3
        self.assertEqual(parameters.cart_mass, 3.0)
        self.assertIn("cart_mass=3.0", repr(parameters))


class Misuse(unittest.TestCase):
    def setUp(self):
        self.model = cart_pole.Model()
        self.state = self.model.initial_state()

    def test_shapes_are_checked(self):
        for wrong in ([1, 2], [[1]], [], "1", [1 + 2j], [None], [True], np.array(["1"])):
            with self.assertRaises((ValueError, TypeError)):
                self.model.forward_dynamics(self.state, wrong)
        with self.assertRaisesRegex(ValueError, r"inputs have shape \(2,\), \(1,\) is needed: push"):
            self.model.rk4_step(self.state, [1, 2], 1e-3)
        with self.assertRaisesRegex(ValueError, r"zdot has shape \(3,\), \(2,\) is needed"):
            self.model.inverse_dynamics(self.state, [1, 2, 3])
        with self.assertRaisesRegex(ValueError, "y has shape"):
            self.state.y = [1]
        with self.assertRaisesRegex(ValueError, "z has shape"):
            cart_pole.State([0, 0], [0])
        with self.assertRaises(TypeError):
            self.model.forward_dynamics(panda.Model().initial_state())
        with self.assertRaises(TypeError):
            self.model.forward_dynamics(None)

    def test_numbers_that_are_not_finite_are_named(self):
        for bad in (np.nan, np.inf, -np.inf):
            with self.assertRaisesRegex(cart_pole.NotFinite, r"inputs\[0\], push, is"):
                self.model.rk4_step(self.state, [bad], 1e-3)
            with self.assertRaisesRegex(cart_pole.NotFinite, "parameter 'cart_mass'"):
                self.model.parameters.cart_mass = bad
            with self.assertRaises(cart_pole.NotFinite):
                self.model.rk4_step(self.state, None, bad)
            with self.assertRaisesRegex(cart_pole.NotFinite, "zdot"):
                self.model.inverse_dynamics(self.state, [0, bad])
        self.state["hinge"] = np.nan
        for call in (lambda: self.model.mass_matrix(self.state), lambda: self.model.rk4_step(self.state, None, 1e-3),
                     lambda: self.model.simulate(self.state, 1, 0.1)):
            with self.assertRaisesRegex(cart_pole.NotFinite, r"y\[1\], hinge, is nan"):
                call()

    def test_a_step_that_fails_leaves_the_state(self):
        self.state["hinge_velocity"] = 1e200
        before = pickle.dumps(self.state)
        with self.assertRaisesRegex(cart_pole.NotFinite, "rk4_step, step 0"):
            self.model.rk4_step(self.state, None, 1.0)
        self.assertEqual(pickle.dumps(self.state), before)
        self.state["hinge_velocity"] = 0
        self.model.rk4_step(self.state, None, 1e-3)

    def test_lengths_of_runs_are_checked(self):
        for arguments in ((1, 0.3), (0, 0.1), (1, -0.1), (np.nan, 0.1), (1, np.inf), ("1", 0.1)):
            with self.assertRaises((ValueError, TypeError)):
                self.model.simulate(self.state, *arguments)
        for named in ({"every": 3}, {"every": 0}, {"every": 1.0}, {"threads": 0}, {"failures": "ignore"}):
            with self.assertRaises(ValueError):
                self.model.simulate(self.state, 1, 0.1, **named)
        with self.assertRaises(ValueError):
            self.model.rk4_step(self.state, None, 0.1, count=0)

    def test_open_loops_are_refused(self):
        model = squeezer.Model()
        state = model.initial_state()
        state[squeezer.POSITIONS[1]] += 1e-3
        self.assertGreater(np.abs(model.constraint_residual(state).g).max(), 1e-6)
        for call in (lambda: model.forward_dynamics(state), lambda: model.rk4_step(state, None, 1e-5),
                     lambda: model.simulate(state, 1e-4, 1e-5), lambda: model.mass_matrix(state.repeat(3))):
            with self.assertRaisesRegex(squeezer.LoopsOpen, r"call `model.close_loops\(state\)` first"):
                call()
        model.close_loops(state)
        self.assertLess(np.abs(model.constraint_residual(state).g).max(), 1e-12)
        model.rk4_step(state, None, 1e-5)
        with self.assertRaises(squeezer.LoopsOpen):
            model.simulate(state, 1, 0.1)

    def test_a_library_of_another_module_is_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            source = os.path.dirname(cart_pole.__file__)
            shutil.copy(os.path.join(source, "cart_pole.py"), folder)
            load = [sys.executable, "-c", "import cart_pole"]
            answer = subprocess.run(load, cwd=folder, capture_output=True, text=True)
            self.assertRegex(answer.stderr, "ImportError: the library of this module cannot be loaded")
            shutil.copy(os.path.join(source, "libcrane.so"), os.path.join(folder, "libcart_pole.so"))
            answer = subprocess.run(load, cwd=folder, capture_output=True, text=True)
            self.assertRegex(answer.stderr, "ImportError: .* were not made together")


class Calls(unittest.TestCase):
    def test_parameters_take_effect_at_once(self):
        model = cart_pole.Model(cart_mass=2)
        state = model.initial_state()
        heavy = model.forward_dynamics(state, {"push": 1})
        model.parameters.cart_mass = 1
        self.assertNotEqual(heavy[0], model.forward_dynamics(state, {"push": 1})[0])
        np.testing.assert_array_equal(model.forward_dynamics(state, {"push": 1}),
                                      cart_pole.Model().forward_dynamics(state, [1]))

    def test_equations_hold(self):
        model, rng = panda.Model(), np.random.default_rng(1)
        for _ in range(20):
            state = panda.State(rng.normal(size=7), rng.normal(size=7))
            u, zdot = rng.normal(size=7), rng.normal(size=7)
            mass = model.mass_matrix(state)
            np.testing.assert_array_equal(mass, mass.T)
            acceleration = model.forward_dynamics(state, u)
            np.testing.assert_allclose(mass @ acceleration, model.k_bar(state) - model.q_bar(state, u), atol=1e-11)
            np.testing.assert_allclose(model.inverse_dynamics(state, acceleration), u, atol=1e-11)
            np.testing.assert_allclose(model.inverse_dynamics(state, zdot),
                                       mass @ zdot - model.k_bar(state) + model.q_bar(state), atol=1e-11)

    def test_linearize_is_the_derivative(self):
        model = cart_pole.Model()
        state = cart_pole.State([0.1, 0.7], [0.3, -0.4])
        A, B, C, D = model.linearize(state, [2.0])
        self.assertEqual((A.shape, B.shape, C.shape, D.shape), ((4, 4), (4, 1), (0, 4), (0, 1)))
        x, d = np.concatenate([state.y, state.z]), 1e-6

        def rate(x, u):
            here = cart_pole.State(x[:2], x[2:])
            return np.concatenate([here.z, model.forward_dynamics(here, u)])
        for k in range(4):
            step = d * np.eye(4)[k]
            np.testing.assert_allclose(A[:, k], (rate(x + step, [2]) - rate(x - step, [2])) / (2 * d), atol=1e-7)
        np.testing.assert_allclose(B[:, 0], (rate(x, [2 + d]) - rate(x, [2 - d])) / (2 * d), atol=1e-7)

    def test_of_a_batch_results_have_a_row_for_each_state(self):
        rng = np.random.default_rng(2)
        for module in (cart_pole, crane, panda, quadrotor):
            model = module.Model()
            states = model.initial_state(5)
            states.y = states.y + 0.1 * rng.normal(size=states.y.shape)
            states.z = rng.normal(size=states.z.shape)
            nu, nz = len(module.INPUTS), len(module.VELOCITIES)
            inputs, zdot = rng.normal(size=(5, nu)), rng.normal(size=(5, nz))
            for name, method in vars(module.Model).items():
                if name in ("simulate", "initial_state", "parameters") or name.startswith("_"):
                    continue
                named = {"inputs": inputs, "zdot": zdot, "h": 1e-3}
                taken = [name for name in inspect.signature(method).parameters if name in named]
                batch, singles = states.copy(), [states[k] for k in range(5)]
                result = method(model, batch, **{name: named[name] for name in taken})
                for k, single in enumerate(singles):
                    one = method(model, single, **{name: named[name][k] if name != "h" else 1e-3 for name in taken})
                    np.testing.assert_array_equal(batch.y[k], single.y)
                    np.testing.assert_array_equal(batch.z[k], single.z)
                    if one is None:
                        continue
                    parts = one.items() if isinstance(one, dict) else enumerate(one if isinstance(one, tuple) else [one])
                    for key, part in parts:
                        whole = result[key] if isinstance(one, (dict, tuple)) else result
                        np.testing.assert_array_equal(whole[k], part)

    def test_inputs_are_the_same_in_every_form(self):
        model = quadrotor.Model()
        state, thrusts = model.initial_state(), [0.07, 0.06, 0.08, 0.05]
        expected = model.forward_dynamics(state, thrusts)
        named = dict(zip(quadrotor.INPUTS, thrusts))
        np.testing.assert_array_equal(model.forward_dynamics(state, named), expected)
        np.testing.assert_array_equal(model.forward_dynamics(state.repeat(2), named), [expected, expected])
        np.testing.assert_array_equal(model.forward_dynamics(state, np.float32(thrusts).astype(float)),
                                      model.forward_dynamics(state, np.float32(thrusts)))
        np.testing.assert_array_equal(model.forward_dynamics(state.repeat(1), np.array([thrusts])[:, ::1]), [expected])
        transposed = np.array([thrusts, thrusts]).T.copy().T  # columns are neighbours
        np.testing.assert_array_equal(model.forward_dynamics(state.repeat(2), transposed), [expected, expected])
        np.testing.assert_array_equal(model.forward_dynamics(state), model.forward_dynamics(state, np.zeros(4)))

    def test_states_are_copied_pickled_and_changed_by_name(self):
        state = cart_pole.Model().initial_state()
        state["hinge"] = 0.5
        self.assertEqual((state["hinge"], state.y[1], state.t), (0.5, 0.5, 0.0))
        for other in (state.copy(), copy.deepcopy(state), pickle.loads(pickle.dumps(state))):
            other["hinge"] = 1
            self.assertEqual(state["hinge"], 0.5)
        model = pickle.loads(pickle.dumps(cart_pole.Model(cart_mass=7)))
        self.assertEqual(model.parameters.cart_mass, 7)


class Steps(unittest.TestCase):
    def test_steps_go_on_as_one_run_does(self):
        for module, h in ((cart_pole, 1e-2), (crane, 1e-2), (quadrotor, 1e-2), (squeezer, 1e-5)):
            model = module.Model()
            inputs = [0.1] * len(module.INPUTS)
            for method in EXPLICIT:
                at_once = model.simulate(model.initial_state(), 12 * h, h, inputs, method=method).end
                state, blocks = model.initial_state(), model.initial_state()
                step = getattr(model, f"{method}_step")
                for _ in range(12):
                    step(state, inputs, h)
                step(blocks, inputs, h, count=5)
                step(blocks, inputs, h, 7)
                for other in (state, blocks):
                    self.assertEqual(at_once.y.tobytes() + at_once.z.tobytes(), other.y.tobytes() + other.z.tobytes(),
                                     (module.__name__, method))
                    self.assertEqual(at_once.t, other.t)

    def test_what_a_method_remembers_ends_with_what_changes(self):
        model = cart_pole.Model()
        step = model.adams_bashforth3_step

        def fresh(y, z, inputs, h):
            state = cart_pole.State(y, z)
            step(state, inputs, h)
            return state.y.tobytes() + state.z.tobytes()
        for change in ("state", "inputs", "h", "method", "parameter"):
            state, inputs, h = model.initial_state(), [1.0], 1e-2
            step(state, inputs, h, count=6)
            if change == "state":
                state["hinge"] = 0.3
            elif change == "inputs":
                inputs = [2.0]
            elif change == "h":
                h = 2e-2
            elif change == "method":
                model.rk4_step(state, inputs, h)
            else:
                model.parameters.cart_mass = 1.5
            expected = fresh(state.y, state.z, inputs, h)
            step(state, inputs, h)
            self.assertEqual(state.y.tobytes() + state.z.tobytes(), expected, change)

    def test_inputs_may_change_with_steps(self):
        model, steps = cart_pole.Model(), 8
        pushes = np.linspace(-1, 1, steps)[:, None]
        expected = model.initial_state()
        for push in pushes:
            model.rk4_step(expected, push, 1e-2)
        start = model.initial_state()
        runs = [model.simulate(start, steps * 1e-2, 1e-2, pushes),
                model.simulate(start, steps * 1e-2, 1e-2, lambda t, y, z: pushes[round(t / 1e-2)])]
        batch = start.repeat(3)
        runs += [model.simulate(batch, steps * 1e-2, 1e-2, pushes[None]),
                 model.simulate(batch, steps * 1e-2, 1e-2, np.tile(pushes, (3, 1, 1)), threads=2),
                 model.simulate(batch, steps * 1e-2, 1e-2, lambda t, y, z: np.full((3, 1), pushes[round(t[0] / 1e-2)]))]
        for run in runs:
            end = run.y[..., -1, :].reshape(-1, 2)
            for row in end:
                np.testing.assert_array_equal(row, expected.y)
            np.testing.assert_array_equal(run.end.y.reshape(-1, 2), end)

    def test_runs_keep_rows_and_outputs(self):
        model = quadrotor.Model()
        for state in (model.initial_state(), model.initial_state(4)):
            for inputs in ([0.07, 0.06, 0.07, 0.07], lambda t, y, z: [0.07, 0.06, 0.07, 0.07]):
                run = model.simulate(state, 0.1, 1e-3, inputs, every=25, outputs=True)
                np.testing.assert_allclose(np.broadcast_to(run.t, run.y.shape[:-1])[..., :],
                                           np.broadcast_to(np.linspace(0, 0.1, 5), run.y.shape[:-1]), atol=1e-15)
                last = run["pose.position"][..., -1, :]
                np.testing.assert_array_equal(last, run.y[..., -1, :3])
                np.testing.assert_array_equal(run["root_z"], run.y[..., 2])
                np.testing.assert_array_equal(run.end.z, run.z[..., -1, :])
                self.assertEqual(run["pose.rotation"].shape, run.y.shape[:-1] + (3, 3))
        self.assertEqual(model.simulate(model.initial_state(), np.float64(0.1), 1e-3, every=np.int64(50)).y.shape, (3, 7))
        only = model.simulate(model.initial_state(), 0.1, 1e-3, outputs="pose.position")
        self.assertEqual(list(only.outputs), ["pose.position"])

    def test_states_that_fail_are_named_or_left_out(self):
        model = cart_pole.Model()
        states = model.initial_state(6)
        states.z[3] = [0, 1e200]
        with self.assertRaisesRegex(cart_pole.NotFinite, "rk4_step, state 3, step 0"):
            model.simulate(states, 1, 0.1, threads=2)
        for inputs in (None, lambda t, y, z: [0.0]):
            run = model.simulate(states, 1, 0.1, inputs, failures="nan", threads=2)
            self.assertEqual(run.failed.tolist(), [3])
            self.assertTrue(np.isnan(run.y[3, 1:]).all() and np.isnan(run.end.y[3]).all())
            self.assertTrue(np.isfinite(np.delete(run.y, 3, axis=0)).all())
            good = model.simulate(states[[0]], 1, 0.1)
            np.testing.assert_array_equal(run.y[5], good.y[0])

    def test_threads_give_the_same_bits(self):
        model, rng = panda.Model(), np.random.default_rng(3)
        states = panda.State(rng.normal(size=(101, 7)), rng.normal(size=(101, 7)), np.zeros(101))
        one = model.simulate(states, 0.1, 1e-3, every=10)
        for threads in (2, 8, 200):
            other = model.simulate(states, 0.1, 1e-3, every=10, threads=threads)
            np.testing.assert_array_equal(one.y, other.y)
            np.testing.assert_array_equal(one.end.z, other.end.z)
        self.assertEqual(model.simulate(states[:0], 0.1, 1e-3).y.shape, (0, 101, 7))

    def test_eight_threads_share_a_model(self):
        models = (panda.Model(), cart_pole.Model())
        expected = [model.simulate(model.initial_state(), 0.1, 1e-3).end for model in models]
        wrong = []

        def work(k):
            model, end = models[k % 2], expected[k % 2]
            for _ in range(5):
                state = model.initial_state()
                for _ in range(100):
                    model.rk4_step(state, None, 1e-3)
                model.mass_matrix(state)
                if state.y.tobytes() != end.y.tobytes():
                    wrong.append(k)
        threads = [threading.Thread(target=work, args=(k,)) for k in range(8)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(wrong, [])

    def test_a_module_can_be_loaded_anew(self):
        expected = cart_pole.Model().initial_state().y.tobytes()
        for _ in range(3):
            module = importlib.reload(sys.modules["cart_pole"])
            self.assertEqual(module.Model().initial_state().y.tobytes(), expected)


if __name__ == "__main__":
    unittest.main()
