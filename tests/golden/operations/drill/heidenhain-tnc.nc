0 BEGIN PGM drill MM
1 ; program drill, HEIDENHAIN TNC
2 ; part drill, aluminium, 4 mm thick
3 ; stock 40.00 x 30.00 x 4 mm, from X-20.000 Y-15.000
4 ; origin: axis of the part, Z0 on top of the stock
5 ; drills go 2.70 mm below the stock: leave room under the holes
6 ; origin preset 1, Z0 on top of the stock, units mm and mm/min
7 ; T7 D 5 mm: drill-5, drill
8 ; T9 D 8 mm: drill-8, drill
9 CYCL DEF 247 DATUM SETTING ~
  Q339=+1 ;DATUM NUMBER
10 CYCL DEF 32.0 TOLERANCE
11 CYCL DEF 32.1 T0.002
12 L Z+0 R0 FMAX M91
13 ; operation: drill 5
14 TOOL CALL 7 Z S5093
15 M3
16 L X-10 Y+5 R0 FMAX
17 L Z+5 R0 FMAX
18 M8
19 L Z+1 R0 FMAX
20 L Z-5.803 F376
21 L Z+5 R0 FMAX
22 L X+10 Y-5 R0 FMAX
23 L Z+1 R0 FMAX
24 L Z-5.803 F376
25 L Z+5 R0 FMAX
26 M9
27 M5
28 L Z+0 R0 FMAX M91
29 ; operation: drill 8
30 TOOL CALL 9 Z S3183
31 M3
32 L X+10 Y+8 R0 FMAX
33 L Z+5 R0 FMAX
34 M8
35 L Z+1 R0 FMAX
36 L Z-6.704 F381
37 L Z+5 R0 FMAX
38 M9
39 M5
40 L Z+0 R0 FMAX M91
41 M30
42 END PGM drill MM
