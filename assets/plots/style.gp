# Settings of all plots. Colours from P. Tol's "bright" and "muted" sets, which colour-blind readers can distinguish.
# A plot is made in a folder of its own, where all names are fixed: from data.txt and texts.txt it makes plot.svg and
# plot.png. Names and titles come as data, never as part of a script or a file's name.
set datafile separator "\t"
set datafile missing ""
set key outside right top samplen 1.5 spacing 1.1
set grid lc rgb "#dddddd"
set border lc rgb "#444444"
set tics textcolor rgb "#444444" nomirror

# The texts, one a line after a "=", which keeps "" and "# x" and "3" apart from blanks, comments and numbers.
stats "texts.txt" using (0) nooutput
lines = int(STATS_records)
array texts[lines]
line = ""
do for [k = 1:lines] {
  stats "texts.txt" every ::(k - 1)::(k - 1) using (line = strcol(1)[2:], 0) nooutput
  texts[k] = line
}

known = "exact crowd listing1 strang runge-kutta-4 taylor-8 moser-veselov-10 bullet bullet-best ode ode-best mujoco mujoco-best mujoco-3 mujoco-3-best jolt jolt-best rapier rapier-best"
colours = "#c8553d #e8a838 #888888 #66ccee #4477aa #ccbb44 #aa3377 #882255 #cc6677 #332288 #88ccee #117733 #999933 #44aa99 #bbcc33 #ee8866 #eedd88 #ee3377 #ffaabb"
points = "7 9 2 4 6 10 12 5 4 9 8 11 13 1 2 3 14 15 6"
place(name) = (sum [i = 1:words(known)] (word(known, i) eq name ? i : 0))
colourOf(name) = place(name) > 0 ? word(colours, place(name)) : "#000000"
pointOf(name) = place(name) > 0 ? int(word(points, place(name))) : 1
sizeOf(name) = name eq "exact" ? 1.6 : 0.8

# Terminals for the two files of a plot.
svg(w, h) = sprintf("set terminal svg size %d,%d dynamic background 'white' font 'DejaVu Sans,12'; set output 'plot.svg'", w, h)
png(w, h) = sprintf("set terminal pngcairo size %d,%d background 'white' font 'DejaVu Sans,11'; set output 'plot.png'", w, h)
