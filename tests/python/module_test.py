"""The Python module beside the program: the same numbers and pictures, to the bit.

    module_test.py CAREEN SCENES STUBS
"""
import ast
import pathlib
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import numpy

import careen

PROGRAM, SCENES, STUBS = sys.argv[1], pathlib.Path(sys.argv[2]), sys.argv[3]
NAMES = ("careen", "zeno", "stack")


def program(folder, *arguments):
    return subprocess.run([PROGRAM, *map(str, arguments)], cwd=folder, check=True, capture_output=True, text=True).stdout


class Module(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)

    def test_states_and_impacts_are_those_of_the_program(self):
        for name in NAMES:
            scene = SCENES / f"{name}.json"
            told = program(self.folder, "simulate", scene, "--verbose", "--npz", "run.npz", "--every", "0.01", "-o", "run.careen")
            run = careen.simulate(scene)
            self.assertIn("state hash   " + run.hash, told)
            self.assertEqual(careen.read_run(self.folder / "run.careen").hash, run.hash)
            table = numpy.load(self.folder / "run.npz")
            self.assertEqual(list(table["box"]), run.boxes)
            states = run.states(table["time"])
            columns = {"position": "x y z", "orientation": "qw qx qy qz", "velocity": "vx vy vz",
                       "angular_velocity": "wx wy wz"}
            for key, names in columns.items():
                expected = numpy.stack([table[column] for column in names.split()], axis=-1)
                numpy.testing.assert_array_equal(states[key], expected, err_msg=f"{name} {key}")
            numpy.testing.assert_array_equal(run.impacts["time"], table["impact_time"])
            numpy.testing.assert_array_equal(run.impacts["impulse"], table["impact_impulse"])
            self.assertEqual(run.impacts["a"], list(table["impact_a"]))
            self.assertEqual(run.impacts["b"], list(table["impact_b"]))
            self.assertEqual(run.impacts["point"].shape, (len(table["impact_time"]), 3))
            energies = run.energy(table["time"])
            for key in "translation rotation gravity springs total motors impacts damping drag remaining".split():
                numpy.testing.assert_array_equal(energies[key], table["energy_" + key], err_msg=f"{name} {key}")
            for key, letter in (("momentum", "p"), ("angular_momentum", "l")):
                expected = numpy.stack([table[f"energy_{letter}{axis}"] for axis in "xyz"], axis=-1)
                numpy.testing.assert_array_equal(energies[key], expected)
            self.assertEqual(run.energy([[0, 0.1]])["momentum"].shape, (1, 2, 3))
            self.assertEqual(run.energy(0)["total"], table["energy_total"][0])
            forces = run.forces([run.duration])
            self.assertEqual(forces["force"].shape, (len(forces["a"]), 3))
            self.assertTrue((forces["time"] == run.duration).all())
            self.assertEqual(set(forces), {"time", "a", "b", "point", "normal", "force", "left"})

    def test_a_control_in_python_is_that_of_the_scene(self):
        scene = SCENES / "pole.json"
        told = []

        def control(time, boxes, joints):
            told.append((time, boxes["position"].shape, boxes["orientation"].shape))
            effort = 0.0
            for name, k, d in (("rail", -2.8295, -4.2276), ("pole", -41.3668, -10.1851)):
                effort -= k * joints[name][0] + d * joints[name][1]
            return {"rail": effort}

        run = careen.simulate(scene, control=control, period=0.02)
        self.assertEqual(run.hash, careen.simulate(scene).hash)
        self.assertEqual(told[50], (50 * 0.02, (3, 3), (3, 4)))
        with self.assertRaisesRegex(careen.Error, "unknown joint"):
            careen.simulate(scene, control=lambda *_: {"rial": 1}, period=0.02)
        with self.assertRaisesRegex(careen.Error, "without a period"):
            careen.simulate(scene, control=control)

    def test_boxes_have_the_inertia_and_the_centre_that_are_given(self):
        tensor = numpy.array([[0.3, 0.05, 0], [0.05, 0.4, -0.02], [0, -0.02, 0.5]])
        center, spin = numpy.array([0.1, -0.05, 0.02]), numpy.array([1.0, 2, 3])
        run = careen.simulate({"careen": 1, "duration": 1, "boxes": [
            {"name": "die", "half_extents": [0.5, 0.5, 0.5], "mass": 2, "position": [0, 0, 0],
             "angular_velocity": spin.tolist(), "inertia": tensor.tolist(), "center": center.tolist()}]})
        times = numpy.linspace(0, 1, 11)
        states = {key: value[:, 0] for key, value in run.states(times).items()}
        w, v = states["orientation"][:, :1], states["orientation"][:, 1:]
        cross, identity = numpy.cross, numpy.eye(3)
        turn = numpy.stack([e + 2 * (w * cross(v, e) + cross(v, cross(v, e))) for e in identity], axis=-1)
        momentum = turn @ tensor @ turn.transpose(0, 2, 1) @ states["angular_velocity"][:, :, None]
        numpy.testing.assert_allclose(momentum[:, :, 0], numpy.tile(tensor @ spin, (11, 1)), rtol=0, atol=1e-13)
        middle = center + times[:, None] * cross(spin, center) - turn @ center
        numpy.testing.assert_allclose(states["position"], middle, rtol=0, atol=1e-13)

    def test_boxes_may_have_several_parts(self):
        half = [0.5, 0.5, 0.5]  # three cubes of 1 m and 1 kg, in an L
        run = careen.simulate({"careen": 1, "duration": 1, "boxes": [
            {"name": "corner", "mass": 3, "angular_velocity": [0, 2, 0], "parts": [
                {"half_extents": half}, {"half_extents": half, "position": [1, 0, 0]},
                {"half_extents": half, "position": [0, 0, 1]}]}]})
        times = numpy.linspace(0, 1, 11)
        found = run.states(times)["position"][:, 0]
        cosine, sine, none = numpy.cos(2 * times), numpy.sin(2 * times), 0 * times
        center = numpy.stack([1 / 3 + 2 / 3 * times, none, 1 / 3 - 2 / 3 * times], axis=-1)
        arm = numpy.stack([(cosine + sine) / 3, none, (cosine - sine) / 3], axis=-1)
        numpy.testing.assert_allclose(found, center - arm, rtol=0, atol=1e-13)

    def test_questions_are_answered_with_moments(self):
        run = careen.simulate({"careen": 1, "duration": 1, "gravity": [0, 0, -9.81], "boxes": [
            {"name": "a", "half_extents": [0.5, 0.5, 0.5], "mass": 2, "position": [0, 0, 2]}]})
        found = run.when("height(a) < 1")
        self.assertEqual(found.shape, (1,))
        self.assertAlmostEqual(found[0], (2 / 9.81) ** 0.5, delta=1e-14)
        self.assertEqual(run.when("rest").shape, (0,))
        with self.assertRaisesRegex(careen.Error, "column 6: found 'b'"):
            run.when("rest(b)")

    def test_times_have_any_shape(self):
        run = careen.simulate(SCENES / "zeno.json")
        boxes = len(run.boxes)
        self.assertEqual(run.states(0.5)["position"].shape, (boxes, 3))
        self.assertEqual(run.states([])["orientation"].shape, (0, boxes, 4))
        grid = numpy.linspace(0, run.duration, 24).reshape(2, 3, 4)
        found = run.states(grid)["velocity"]
        self.assertEqual(found.shape, (2, 3, 4, boxes, 3))
        numpy.testing.assert_array_equal(found[1, 2, 0], run.states(grid[1, 2, 0])["velocity"])
        numpy.testing.assert_array_equal(run.states(grid.T)["velocity"], numpy.transpose(found, (2, 1, 0, 3, 4)))
        for time_of in (-1e-9, run.duration + 1e-9, float("nan")):
            self.assertRaises(careen.Error, run.states, [0, time_of])

    def test_films_files_and_sweeps_are_those_of_the_program(self):
        code = """
import careen, sys
run = careen.simulate(sys.argv[1])
run.film("own", frames="0-4:2", size=(64, 36), alpha=True)
run.labels("own-labels", channels="depth", frames="1", size=(64, 36))
run.page("own.html", quality="draft", size=(64, 36))
run.export("own.csv", 0.1)
"""  # in a process of its own: after frame() there is none
        scene = SCENES / "careen.json"
        subprocess.run([sys.executable, "-c", code, scene], cwd=self.folder, check=True)
        program(self.folder, "render", scene, "--alpha", "--frames", "0-4:2", "--size", "64x36", "--out", "theirs")
        program(self.folder, "export", scene, "-o", "theirs.csv", "--every", "0.1")
        program(self.folder, "truth", scene, "--channels", "depth", "--frames", "1", "--size", "64x36", "-o", "theirs-labels")
        program(self.folder, "page", scene, "--quality", "draft", "--size", "64x36", "-o", "theirs.html")
        for name in ("{}.csv", "{}/000000.png", "{}/000002.png", "{}/000004.png", "{}-labels/000001.npz", "{}.html"):
            self.assertEqual((self.folder / name.format("own")).read_bytes(),
                             (self.folder / name.format("theirs")).read_bytes(), name)
        family = self.folder / "family.json"
        family.write_text('{"careen": 1, "duration": 1, "boxes": [{"half_extents": [1, 1, 1], "mass": {"uniform": [1, 2]}}]}')
        table, rows, broken = careen.sweep(family, self.folder / "sweep", runs=(0, 4), jobs=1)
        self.assertEqual((rows, broken), (5, 0))
        program(self.folder, "sweep", family, "--runs", "0-4", "--out", "other")
        self.assertEqual(table.read_bytes(), (self.folder / "other/table.csv").read_bytes())
        run = careen.simulate(scene)
        self.assertTrue(run.difference_from(careen.simulate(scene))["same"])
        self.assertIsNotNone(run.difference_from(careen.simulate(scene, method="listing1"))["from"])

    def test_runs_are_made_and_compared_as_by_the_program(self):
        scene = SCENES / "zeno.json"
        ended = careen.simulate(scene, until="rest")
        self.assertLess(ended.duration, careen.simulate(scene).duration)
        self.assertEqual(careen.simulate(scene, duration=0.5).duration, 0.5)
        self.assertRaises(careen.Error, careen.simulate, scene, dt=0.01)
        stepped = careen.simulate(scene, method="listing1", dt=0.01)
        self.assertEqual(stepped.report["dt"], 0.01)
        self.assertEqual(ended.report["until"]["question"], "rest")
        self.assertLess(ended.estimate_error()["position"], 1e-6)
        ended.save(self.folder / "ended.careen")
        stepped.save(self.folder / "stepped.careen")
        self.assertTrue(careen.compare(self.folder / "ended.careen", self.folder / "ended.careen")["same"])
        found = careen.compare(self.folder / "ended.careen", self.folder / "stepped.careen", page=self.folder / "page")
        self.assertFalse(found["same"])
        self.assertEqual(found["report"]["headline"], found["headline"])
        self.assertTrue((self.folder / "page/index.html").exists())
        careen.simulate(scene, method="listing1", dt=0.005).save(self.folder / "finer.careen")
        for far, same in ((0.5, True), (1e-9, False)):
            found = careen.compare(self.folder / "stepped.careen", self.folder / "finer.careen", motion=far, until=0.1)
            self.assertEqual(found["same"], same, found["headline"])
        ended.export(self.folder / "poses.csv", 0.1)
        self.assertRaises(careen.Error, careen.read_run, self.folder / "poses.csv")
        table = careen.read_run(self.folder / "poses.csv", scene)
        numpy.testing.assert_array_equal(table.states(0.1)["position"], ended.states(0.1)["position"])

    def test_stubs_name_all_that_there_is(self):
        stubs = ast.parse((pathlib.Path(STUBS) / "__init__.pyi").read_text())
        named = {node.name: node for node in stubs.body if isinstance(node, (ast.ClassDef, ast.FunctionDef))}
        there = {name for name in dir(careen) if not name.startswith("_")}
        self.assertEqual({name for name in named if not name.startswith("_")}, there)
        methods = {node.name for node in named["Run"].body if isinstance(node, ast.FunctionDef)}
        self.assertEqual(methods, {name for name in dir(careen.Run) if not name.startswith("_")})

    def test_pictures_are_those_of_the_program(self):
        scene = SCENES / "careen.json"
        program(self.folder, "render", scene, "--still", "1.5", "--size", "160x90", "--out", "still.png")
        subprocess.run(["ffmpeg", "-loglevel", "error", "-i", "still.png", "-f", "rawvideo", "-pix_fmt", "rgb24", "raw"],
                       cwd=self.folder, check=True)
        expected = numpy.fromfile(self.folder / "raw", dtype=numpy.uint8).reshape(90, 160, 3)
        numpy.testing.assert_array_equal(careen.simulate(scene).frame(1.5, size=(160, 90)), expected)

    def test_errors_have_a_place(self):
        bad = self.folder / "bad.json"
        bad.write_text('{ "careen": 1, "duration": 1,\n  "boxen": [] }')
        with self.assertRaises(careen.SceneError) as caught:
            careen.simulate(bad)
        self.assertEqual((caught.exception.file, caught.exception.line, caught.exception.column), (str(bad), 2, 3))
        self.assertIn("boxen", str(caught.exception))
        self.assertIsInstance(caught.exception, careen.Error)
        for scene in ({}, {"careen": 1}, self.folder / "nowhere.json"):
            self.assertRaises(careen.SceneError, careen.simulate, scene)
        self.assertRaises(careen.SceneError, careen.simulate, SCENES / "careen.json", method="guess")
        self.assertRaises(careen.SceneError, careen.simulate, SCENES / "careen.json", tolerance=-1)
        self.assertRaises(careen.Error, careen.simulate, SCENES / "careen.json", threads=0)
        run = careen.simulate(SCENES / "careen.json")
        self.assertRaises(careen.Error, run.frame, 99)
        self.assertRaises(careen.Error, run.frame, 0, size=(0, 1))

    def test_the_lock_is_free_while_it_simulates(self):
        stack = SCENES / "stack.json"
        begun = time.perf_counter()
        alone = careen.simulate(stack).hash
        seconds = time.perf_counter() - begun
        hashes, ticks = [], 0
        threads = [threading.Thread(target=lambda: hashes.append(careen.simulate(stack).hash))
                   for _ in range(2)]
        for thread in threads:
            thread.start()
        while any(thread.is_alive() for thread in threads):
            time.sleep(seconds / 50)
            ticks += 1
        self.assertEqual(hashes, [alone, alone])
        self.assertGreater(ticks, 10)  # one or two if the lock were held; measured about 50

    # In a process of its own, where no array has been made before: NumPy was once loaded by the first two threads.
    def test_threads_may_make_the_first_arrays(self):
        code = ("import careen\nfrom concurrent.futures import ThreadPoolExecutor\n"
                f"run = careen.simulate({str(SCENES / 'careen.json')!r})\n"
                "with ThreadPoolExecutor(8) as pool: print(len(list(pool.map(lambda k: run.states(k / 20), range(40)))))")
        for _ in range(5):
            told = subprocess.run([sys.executable, "-c", code], timeout=30, check=True, capture_output=True, text=True)
            self.assertEqual(told.stdout, "40\n")

    # A plate of .5 m/s and restitution 1 throws what stands there at 1 m/s, after .4 s, by four corners.
    def test_fixed_boxes_move(self):
        plate = {"name": "plate", "half_extents": [0.1, 0.5, 0.5], "position": [-0.4, 0, 0], "fixed": True,
                 "restitution": 1, "motion": {"velocity": [0.5, 0, 0]}}
        ball = {"name": "ball", "half_extents": [0.1, 0.1, 0.1], "mass": 1, "position": [0, 0, 0]}
        scene = {"careen": 1, "duration": 1, "gravity": [0, 0, 0], "boxes": [plate, ball]}
        run = careen.simulate(scene)
        states = run.states(1)
        numpy.testing.assert_allclose(states["position"][:, 0], [0.1, 0.6], atol=1e-14)
        numpy.testing.assert_allclose(states["velocity"][:, 0], [0.5, 1], atol=1e-14)
        numpy.testing.assert_allclose(run.impacts["time"], [0.4] * 4, atol=1e-14)
        with self.assertRaises(careen.SceneError) as caught:
            careen.simulate({**scene, "boxes": [{**plate, "motion": {}}, ball]})
        self.assertIn("no motion", str(caught.exception))
        self.assertIn("motion", careen.simulate.__doc__)

    def test_the_audit_tells_kinds_and_breaches(self):
        audit = careen.simulate(SCENES / "zeno.json").audit
        self.assertEqual(audit["breaches"], [])
        self.assertEqual(audit["box_overlap"]["unit"], "m")
        self.assertTrue(audit["not_finite"]["promised"])

    def test_everything_says_what_it_is(self):
        for thing in (careen, careen.simulate, careen.read_run, careen.Run, careen.SceneError, careen.Run.states,
                      careen.Run.impacts, careen.Run.audit, careen.Run.frame, careen.Run.film, careen.Run.save, careen.Run.hash, careen.sweep):
            self.assertGreater(len(thing.__doc__), 15, thing)
        self.assertEqual("careen " + careen.__version__, program(self.folder, "--version").strip())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
