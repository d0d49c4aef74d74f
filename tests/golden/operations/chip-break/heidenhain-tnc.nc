0 BEGIN PGM chip-break MM
1 ; program chip-break, HEIDENHAIN TNC
2 ; part chip-break, aluminium, 18 mm thick
3 ; stock 40.00 x 30.00 x 18 mm, from X-20.000 Y-15.000
4 ; origin: axis of the part, Z0 on top of the stock
5 ; drills go 1.80 mm below the stock: leave room under the holes
6 ; origin preset 1, Z0 on top of the stock, units mm and mm/min
7 ; T7 D 5 mm: drill-5, drill
8 CYCL DEF 247 DATUM SETTING ~
  Q339=+1 ;DATUM NUMBER
9 CYCL DEF 32.0 TOLERANCE
10 CYCL DEF 32.1 T0.002
11 L Z+0 R0 FMAX M91
12 ; operation: drill 5
13 TOOL CALL 7 Z S5093
14 M3
15 L X-10 Y+5 R0 FMAX
16 L Z+5 R0 FMAX
17 M8
18 L Z+1 R0 FMAX
19 L Z-4 F376
20 L Z-3.75 R0 FMAX
21 L Z-9 F376
22 L Z-8.75 R0 FMAX
23 L Z-14 F376
24 L Z-13.75 R0 FMAX
25 L Z-19 F376
26 L Z-18.75 R0 FMAX
27 L Z-19.803 F376
28 L Z+5 R0 FMAX
29 L X+10 Y-5 R0 FMAX
30 L Z+1 R0 FMAX
31 L Z-4 F376
32 L Z-3.75 R0 FMAX
33 L Z-9 F376
34 L Z-8.75 R0 FMAX
35 L Z-14 F376
36 L Z-13.75 R0 FMAX
37 L Z-19 F376
38 L Z-18.75 R0 FMAX
39 L Z-19.803 F376
40 L Z+5 R0 FMAX
41 M9
42 M5
43 L Z+0 R0 FMAX M91
44 M30
45 END PGM chip-break MM
