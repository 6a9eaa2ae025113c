export const title = 'the page shows the building, and is for nobody else';

export async function run({page, studio, check, picture}) {
  const answer = await page.goto(studio.address);
  check(answer.status() === 200, 'the address that is printed leads to the page');
  await page.getByText('house', {exact: true}).first().waitFor();
  check(true, 'the building has its name');
  await page.locator('canvas').first().waitFor();
  await picture('page');

  const stranger = await page.request.get(`${studio.origin}/`, {failOnStatusCode: false});
  check(stranger.status() === 403, 'without the token there is no page');
}
