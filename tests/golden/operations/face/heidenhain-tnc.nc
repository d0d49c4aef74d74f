0 BEGIN PGM face MM
1 ; program face, HEIDENHAIN TNC
2 ; part face, aluminium, 4 mm thick
3 ; stock 40.00 x 30.00 x 4 mm, from X-20.000 Y-15.000
4 ; origin: axis of the part, Z0 on top of the stock
5 ; origin preset 1, Z0 on top of the stock, units mm and mm/min
6 ; T20 D 16 mm: mill-16, end mill
7 CYCL DEF 247 DATUM SETTING ~
  Q339=+1 ;DATUM NUMBER
8 CYCL DEF 32.0 TOLERANCE
9 CYCL DEF 32.1 T0.002
10 L Z+0 R0 FMAX M91
11 ; operation: face: face
12 CYCL DEF 32.0 TOLERANCE
13 CYCL DEF 32.1 T0.02
14 TOOL CALL 20 Z S4377
15 M3
16 L X-29 Y-10 R0 FMAX
17 L Z+5 R0 FMAX
18 M8
19 L Z+1 R0 FMAX
20 L Z-0.5 F2328
21 L X+29
22 L Y+0
23 L X-29
24 L Y+10
25 L X+29
26 L Z+5 R0 FMAX
27 M9
28 M5
29 L Z+0 R0 FMAX M91
30 M30
31 END PGM face MM
