# Platform motion y(t). Redraw: gnuplot -d motion_y.gp
set terminal svg size 1000,300 dynamic noenhanced font 'sans-serif,14' background '#ffffff'
set output 'motion_y.svg'
set encoding utf8
set datafile separator ','
set datafile columnheaders
set key noautotitle
set border 3 lc rgb '#8a8f98' lw 1
set tics nomirror out scale 0.5 font ',12' textcolor rgb '#3c4149'
set xtics offset 0,0.3
set grid xtics ytics back lc rgb '#e6e8eb' lw 1 dt solid
set key outside top left horizontal Left reverse width 1 samplen 1.6 spacing 1.15 textcolor rgb '#3c4149'
set lmargin 11
set rmargin 3
set tmargin 2
set style line 1 lc rgb '#31688e' lw 1.2
set style line 2 lc rgb '#c2571a' lw 1.4
set style line 3 lc rgb '#35a37a' lw 1.2
set style line 4 lc rgb '#8a8f98' lw 1.0
set style fill solid 1.0 noborder
set palette defined (0 '#440154', 1 '#482878', 2 '#3e4989', 3 '#31688e', 4 '#26828e', 5 '#1f9e89', 6 '#35b779', 7 '#6ece58', 8 '#b5de2b', 9 '#fde725')
set label 99 '400_300_100: coupled, dt 0.05 s, seed 1  gem 0.1.0 (4e93e10c64dd)' at screen 0.995, graph 1.0 right offset 0,0.9 font ',9' textcolor rgb '#9aa0a8' noenhanced front
set xlabel 'time [s]' offset 0,0.4
set ylabel 'y [m]'
set xrange [0:2400.00]
set xzeroaxis lc rgb '#8a8f98' lw 0.8 dt solid
plot 'motion_y.csv' using 1:2 with lines linestyle 2
